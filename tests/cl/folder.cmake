target_compile_definitions(test_cl PRIVATE POWERCELL_SOURCE_FOLDER="${PROJECT_SOURCE_DIR}")
