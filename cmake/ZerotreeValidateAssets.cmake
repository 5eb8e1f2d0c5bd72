# zerotree_validate_assets: a build that fails when an asset is broken or over its budget.
#
#   zerotree_validate_assets(
#     TARGET name
#     [FILES file...] [DIRECTORY folder...]             one of both at least
#     [MAX_BYTES n] [MAX_ERROR e] [MAX_TRIANGLES n]     budgets, as `zerotree validate` takes them
#     [OPTIONS option...]                               more options of `zerotree validate`
#     [REPORT file.json] [JUNIT file.xml]               reports
#     [ALL])
#
# TARGET      If there is a target of this name, it gets a dependency: it is not built while an
#             asset is broken. (The checks are then the target NAME_assets, NAME_assets_2, ...)
#             Otherwise it is the name of the custom target that is made here.
# FILES       .glb, .gltf or .zt files, relative to the current source folder. They are there when
#             CMake runs, or the build of this folder makes them: outputs of add_custom_command,
#             with full paths.
# DIRECTORY   Folders, relative to the current source folder: all .glb, .gltf and .zt files in them
#             and in their subfolders. A build notices files that come and go.
# REPORT, JUNIT  Relative to the current binary folder. They are written whether the check succeeds
#             or fails.
# ALL         The checks run in the default build.
#
# A file is checked again when it changed, or a file that it names (buffers, images), the options or
# the command. (Build tools cannot follow buffers with #, & or % in their names; Ninja then checks
# the file in every build.) Files are checked in parallel; with REPORT or JUNIT one call checks all
# files, because one report tells of them all.
#
# Needs CMake 3.20 and the target zerotree::zerotree: find_package(zerotree COMPONENTS command), or
# add_subdirectory of zerotree with its converter. Errors end the configuration: an unknown
# or an empty argument, a file that is not there, a folder without assets, a command that is not installed.
include_guard(GLOBAL)
cmake_policy(PUSH)
cmake_policy(VERSION 3.5...3.25)

# Sets OUT to the full paths of the files and of the assets in the folders, each once.
function(_zerotree_list_assets out files folders)
  set(assets)
  foreach(file IN LISTS files)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    get_source_file_property(is_generated "${file}" GENERATED)
    if(NOT is_generated AND (NOT EXISTS "${file}" OR IS_DIRECTORY "${file}"))
      message(FATAL_ERROR "zerotree_validate_assets: there is no file ${file}. FILES are relative \
to ${CMAKE_CURRENT_SOURCE_DIR}; for a folder use DIRECTORY, for a file that the build makes its \
full path.")
    endif()
    list(APPEND assets "${file}")
  endforeach()
  foreach(folder IN LISTS folders)
    cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    file(GLOB_RECURSE found CONFIGURE_DEPENDS "${folder}/*.glb" "${folder}/*.gltf" "${folder}/*.zt")
    if(NOT found)
      message(FATAL_ERROR "zerotree_validate_assets: there is no .glb, .gltf or .zt file in \
${folder}. DIRECTORY is relative to ${CMAKE_CURRENT_SOURCE_DIR}.")
    endif()
    list(APPEND assets ${found})
  endforeach()
  list(REMOVE_DUPLICATES assets)
  set(${out} "${assets}" PARENT_SCOPE)
endfunction()

# Adds the command that checks some files together, and sets OUT to the stamp it leaves.
function(_zerotree_add_check out target files options reports)
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/ZerotreeWriteAssetDepfile.cmake)
  string(SHA256 hash "${files}")
  string(SUBSTRING ${hash} 0 16 hash)
  set(stamp ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/zerotree_assets/${target}/${hash}.stamp)
  list(LENGTH files count)
  set(what "${count} assets")
  if(count EQUAL 1)
    cmake_path(RELATIVE_PATH files BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE what)
  endif()
  add_custom_command(
    OUTPUT ${stamp}
    BYPRODUCTS ${reports}
    COMMAND zerotree::zerotree validate ${files} ${options}
    COMMAND ${CMAKE_COMMAND} "-DASSETS=${files}" -DSTAMP=${stamp} -P ${script}
    DEPENDS ${files} $<TARGET_FILE:zerotree::zerotree> ${script}
    DEPFILE ${stamp}.d
    COMMENT "Validating ${what}"
    VERBATIM)
  set(${out} ${stamp} PARENT_SCOPE)
endfunction()

# Sets OUT to the options of the command, and REPORTS to the files it is to write, from the
# arguments ASSETS_... of the caller.
function(_zerotree_list_options out reports)
  set(options ${ASSETS_OPTIONS})
  foreach(budget BYTES ERROR TRIANGLES)
    if(DEFINED ASSETS_MAX_${budget})
      string(TOLOWER ${budget} name)
      list(APPEND options --max-${name} "${ASSETS_MAX_${budget}}")
    endif()
  endforeach()
  set(written)
  set(REPORT_option --output)
  set(JUNIT_option --junit)
  foreach(kind REPORT JUNIT)
    if(DEFINED ASSETS_${kind})
      set(file "${ASSETS_${kind}}")
      cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} NORMALIZE)
      cmake_path(GET file PARENT_PATH folder)
      file(MAKE_DIRECTORY "${folder}")
      list(APPEND options ${${kind}_option} "${file}")
      list(APPEND written "${file}")
    endif()
  endforeach()
  set(${out} "${options}" PARENT_SCOPE)
  set(${reports} "${written}" PARENT_SCOPE)
endfunction()

# Ends the configuration unless the arguments ASSETS_... of the caller make sense.
function(_zerotree_check_arguments)
  if(CMAKE_VERSION VERSION_LESS 3.20)
    message(FATAL_ERROR "zerotree_validate_assets: needs CMake 3.20, this is ${CMAKE_VERSION}.")
  elseif(ASSETS_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "zerotree_validate_assets: unknown arguments: ${ASSETS_UNPARSED_ARGUMENTS}")
  elseif(ASSETS_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "zerotree_validate_assets: no value for ${ASSETS_KEYWORDS_MISSING_VALUES}")
  elseif(NOT ASSETS_TARGET)
    message(FATAL_ERROR "zerotree_validate_assets: TARGET is missing")
  elseif(NOT ASSETS_FILES AND NOT ASSETS_DIRECTORY)
    message(FATAL_ERROR "zerotree_validate_assets: FILES or DIRECTORY is missing")
  elseif(NOT TARGET zerotree::zerotree)
    message(FATAL_ERROR "zerotree_validate_assets: the command zerotree is not here: call \
find_package(zerotree REQUIRED COMPONENTS command) in this folder or above it; the package has the \
command if it was installed with its component \"command\". With add_subdirectory, set \
ZEROTREE_BUILD_CONVERTER to ON.")
  endif()
endfunction()

function(zerotree_validate_assets)
  cmake_parse_arguments(PARSE_ARGV 0 ASSETS
    "ALL" "TARGET;MAX_BYTES;MAX_ERROR;MAX_TRIANGLES;REPORT;JUNIT" "FILES;DIRECTORY;OPTIONS")
  _zerotree_check_arguments()
  # An unset variable in quotes must not switch a budget off: the parser passes over it.
  math(EXPR last "${ARGC} - 1")
  foreach(i RANGE ${last})
    if("${ARGV${i}}" STREQUAL "")
      message(FATAL_ERROR "zerotree_validate_assets: an argument is empty")
    endif()
  endforeach()
  _zerotree_list_assets(assets "${ASSETS_FILES}" "${ASSETS_DIRECTORY}")
  _zerotree_list_options(options reports)

  set(target ${ASSETS_TARGET})
  if(TARGET ${ASSETS_TARGET})
    set(target ${ASSETS_TARGET}_assets)
    set(number 1)
    while(TARGET ${target})
      math(EXPR number "${number} + 1")
      set(target ${ASSETS_TARGET}_assets_${number})
    endwhile()
  endif()

  if(reports)
    # The list is twice in the command, of which Linux gives a shell 128 KiB.
    string(LENGTH "${assets}" length)
    if(length GREATER 50000)
      message(FATAL_ERROR "zerotree_validate_assets: too many files for one report: call it for \
several targets, with a report each.")
    endif()
    _zerotree_add_check(stamps ${target} "${assets}" "${options}" "${reports}")
  else()
    set(stamps)
    foreach(asset IN LISTS assets)
      _zerotree_add_check(stamp ${target} "${asset}" "${options}" "")
      list(APPEND stamps ${stamp})
    endforeach()
  endif()

  set(all)
  if(ASSETS_ALL)
    set(all ALL)
  endif()
  add_custom_target(${target} ${all} DEPENDS ${stamps})
  if(NOT target STREQUAL ASSETS_TARGET)
    add_dependencies(${ASSETS_TARGET} ${target})
  endif()
endfunction()

cmake_policy(POP)
