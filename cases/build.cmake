set(PUFFIN_BUILD_SOURCES build.cpp build_air.cpp build_carriers.cpp)
