# The scene: what is drawn. Included by ig/CMakeLists.txt.
file(GLOB EYEPOINT_SHADERS CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/render/shaders/*.glsl)
set(EYEPOINT_SHADER_TEXT ${CMAKE_CURRENT_BINARY_DIR}/shader_text.cpp)
add_custom_command(OUTPUT ${EYEPOINT_SHADER_TEXT}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR}/render/shaders -DOUTPUT=${EYEPOINT_SHADER_TEXT}
        -P ${CMAKE_SOURCE_DIR}/cmake/embed_shaders.cmake
    DEPENDS ${EYEPOINT_SHADERS} ${CMAKE_SOURCE_DIR}/cmake/embed_shaders.cmake VERBATIM)
target_sources(eyepoint_ig PRIVATE
    ${EYEPOINT_SHADER_TEXT}
    render/block_store.cpp
    render/draw_list.cpp
    render/floor_pass.cpp
    render/frame_uniforms.cpp
    render/image_store.cpp
    render/index_store.cpp
    render/noise_texture.cpp
    render/program.cpp
    render/range_allocator.cpp
    render/resolve_pass.cpp
    render/shading_trial.cpp
    render/sky_pass.cpp
    render/slot_table.cpp
    render/still_mesh.cpp
    render/surface_buffer.cpp
    render/terrain_pass.cpp
    recorded_flight.cpp
    scene.cpp
)
