# The GDAL side of the terrain compiler: elevation and imagery files as surface sources, and the build command.
set(EYEPOINT_INGEST_SOURCES
    build_command.cpp
    build_command_report.cpp
    gdal_elevation.cpp
    gdal_folder.cpp
    gdal_georeference.cpp
    gdal_imagery.cpp
    gdal_inputs.cpp
    gdal_mapping.cpp
    gdal_session.cpp
    imagery_mosaic.cpp
    imagery_pyramid.cpp
    mosaic.cpp
    mosaic_distance.cpp
    mosaic_grid.cpp
    mosaic_layer.cpp
    sea_mask.cpp
    vertical_datum.cpp
    void_fill.cpp
    void_fill_plate.cpp
    void_fill_relief.cpp
)
list(TRANSFORM EYEPOINT_INGEST_SOURCES PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
add_library(eyepoint_terrain_ingest STATIC ${EYEPOINT_INGEST_SOURCES})
target_compile_definitions(eyepoint_terrain_ingest PRIVATE EYEPOINT_VERSION="${PROJECT_VERSION}")
target_link_libraries(eyepoint_terrain_ingest
    PUBLIC eyepoint_terrain_compiler CLI11::CLI11 PkgConfig::GDAL
    PRIVATE fmt::fmt nlohmann_json::nlohmann_json)
