# Debian 12's OpenSubdivConfig.cmake fails (its targets file names a static library that the
# package does not ship), so the library is found by hand.
find_path(OPENSUBDIV_INCLUDE_DIR opensubdiv/far/topologyRefiner.h REQUIRED)
find_library(OPENSUBDIV_CPU_LIBRARY osdCPU REQUIRED)
add_library(zerotree_opensubdiv SHARED IMPORTED)
set_target_properties(zerotree_opensubdiv PROPERTIES
  IMPORTED_LOCATION ${OPENSUBDIV_CPU_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${OPENSUBDIV_INCLUDE_DIR})

if(ZEROTREE_BUILD_CONVERTER)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(TinyGLTF CONFIG REQUIRED)
  find_package(nlohmann_json REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(TBB CONFIG REQUIRED)
  find_package(embree 3 CONFIG REQUIRED)
  find_package(draco CONFIG REQUIRED)
  # Debian's libdraco exports the functions of an older tinygltf with other struct layouts. Whichever
  # library is linked first gives both their functions, so tinygltf must come before Draco.
  set_property(TARGET TinyGLTF::TinyGLTF APPEND PROPERTY INTERFACE_LINK_LIBRARIES draco::draco)
  find_package(meshoptimizer CONFIG REQUIRED)
  find_package(ZLIB REQUIRED)
  find_package(pugixml CONFIG REQUIRED)
  find_path(STB_INCLUDE_DIR stb/stb_image_write.h REQUIRED)
  find_library(STB_LIBRARY stb REQUIRED)
endif()
if(ZEROTREE_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(OpenMesh CONFIG REQUIRED)
endif()
