# zerotree_room(NAME SOURCES file... DEPENDS target...)
# One room of the house: a static library zerotree_NAME that sees only what it depends on.
# Headers are included as "room/file.h" from the room's src folder.
function(zerotree_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(zerotree_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(zerotree_${name} PUBLIC ${PROJECT_SOURCE_DIR}/runtime/include
                                                     ${PROJECT_BINARY_DIR}/runtime/include)
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR PARENT_PATH parent)
  target_include_directories(zerotree_${name} PUBLIC ${parent})
  target_link_libraries(zerotree_${name} PUBLIC zerotree_flags ${ROOM_DEPENDS})
endfunction()

# zerotree_unit_test(NAME SOURCES file... DEPENDS target...)
# One GoogleTest program; each of its tests is a ctest test.
function(zerotree_unit_test name)
  cmake_parse_arguments(TEST "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(test_${name} ${TEST_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${TEST_DEPENDS} zerotree_test_support GTest::gtest
                                             GTest::gtest_main)
  gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60)
endfunction()
