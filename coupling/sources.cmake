set(PUFFIN_COUPLING_SOURCES
  cell_index.cpp
  drag.cpp
  drag_limit.cpp
  kernel.cpp
  stencils.cpp
  transfer.cpp
  volume_fraction.cpp)
