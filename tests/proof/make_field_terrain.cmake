# Makes a database of the benchmark field, unless one newer than the program that makes it is there or there is no real
# data. cmake -DPROGRAM=eyepoint-terrain -DFOLDER=... -P make_field_terrain.cmake
if("$ENV{EYEPOINT_REAL_DATA}" STREQUAL "")
    return()
endif()
if(EXISTS ${FOLDER}/manifest.json AND ${FOLDER}/manifest.json IS_NEWER_THAN ${PROGRAM})
    return()
endif()
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${PROGRAM} build --dem $ENV{EYEPOINT_REAL_DATA}/benchmark/rainier-refined-4097.tif
    --vertical ellipsoid --max-depth 13 -o ${FOLDER} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
