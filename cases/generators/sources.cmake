# Parametric devices and test shapes, and the dose put into them. Paths relative to cases/.
set(PUFFIN_GENERATOR_SOURCES
    dose.cpp
    dose_stack.cpp
    generators/catalogue.cpp
    generators/devices.cpp
    generators/ear_clipping.cpp
    generators/faces.cpp
    generators/obstacle.cpp
    generators/outline.cpp
    generators/pressure_estimate.cpp
    generators/refine.cpp
    generators/round_shapes.cpp
    generators/straight_shapes.cpp
    generators/surface.cpp)
