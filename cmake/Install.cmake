# What `cmake --install` installs, by component:
#   runtime       libzerotree.so.0.1
#   development   headers, libzerotree.a and libzerotree.so, the CMake package, zerotree.pc
#   command       bin/zerotree, and its target for the CMake package
# Everything finds its parts relative to where it lies, so the prefix can be moved.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/zerotree)

install(TARGETS zerotree_runtime EXPORT zerotree_static ARCHIVE COMPONENT development)
install(TARGETS zerotree_runtime_shared EXPORT zerotree_shared
        LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
install(FILES runtime/include/zerotree/zerotree.h runtime/include/zerotree/zerotree.hpp
              ${PROJECT_BINARY_DIR}/runtime/include/zerotree/version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/zerotree COMPONENT development)
foreach(kind static shared)
  install(EXPORT zerotree_${kind} NAMESPACE zerotree:: FILE zerotree_${kind}.cmake
          DESTINATION ${package_dir} COMPONENT development)
endforeach()

configure_package_config_file(cmake/zerotreeConfig.cmake.in ${PROJECT_BINARY_DIR}/zerotreeConfig.cmake
                              INSTALL_DESTINATION ${package_dir}
                              NO_SET_AND_CHECK_MACRO)
# Until 1.0 each minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/zerotreeConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/zerotreeConfig.cmake
              ${PROJECT_BINARY_DIR}/zerotreeConfigVersion.cmake
              cmake/ZerotreeValidateAssets.cmake cmake/ZerotreeWriteAssetDepfile.cmake
        DESTINATION ${package_dir} COMPONENT development)

cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_INCLUDEDIR BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig
           OUTPUT_VARIABLE pkgconfig_include_dir)
configure_file(cmake/zerotree.pc.in ${PROJECT_BINARY_DIR}/zerotree.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/zerotree.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)

if(ZEROTREE_BUILD_CONVERTER)
  install(TARGETS zerotree EXPORT zerotree_command RUNTIME COMPONENT command)
  install(EXPORT zerotree_command NAMESPACE zerotree:: FILE zerotree_command.cmake
          DESTINATION ${package_dir} COMPONENT command)
endif()
