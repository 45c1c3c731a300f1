target_sources(eyepoint_terrain PRIVATE
)
