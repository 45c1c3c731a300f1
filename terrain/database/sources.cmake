target_sources(eyepoint_terrain PRIVATE
    database/block_codec.cpp
    database/database.cpp
    database/database_writer.cpp
    database/durable_file.cpp
    database/image_codec.cpp
    database/manifest_json.cpp
    database/mesh_codec.cpp
    database/mesh_gates.cpp
    database/mesh_place_codec.cpp
    database/mesh_places.cpp
    database/mesh_structure.cpp
    database/range_coder.cpp
    database/shard.cpp
    database/virtual_tile.cpp
    database/whole_grid.cpp
)
