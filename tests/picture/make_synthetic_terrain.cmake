# Makes the synthetic terrain of the picture tests, unless one newer than the program that makes it is there.
# cmake -DPROGRAM=eyepoint-terrain -DFOLDER=... -P make_synthetic_terrain.cmake
if(EXISTS ${FOLDER}/manifest.json AND ${FOLDER}/manifest.json IS_NEWER_THAN ${PROGRAM})
    return()
endif()
execute_process(COMMAND ${PROGRAM} synth -o ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
