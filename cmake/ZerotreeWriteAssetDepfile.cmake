# The second step of a check of zerotree_validate_assets, when the assets are known to be right:
# writes STAMP, and STAMP.d, which tells Ninja and Make what other files (buffers, images) the assets
# name.
#   cmake -DASSETS=file... -DSTAMP=file -P ZerotreeWriteAssetDepfile.cmake
cmake_minimum_required(VERSION 3.20)

# Sets OUT to the glTF JSON of a file, empty if it has none (.zt).
function(read_json out asset)
  set(json)
  file(READ "${asset}" head LIMIT 16 HEX)
  # "glTF", version, length, length of the JSON
  if(head MATCHES "^676c5446................(..)(..)(..)(..)")
    math(EXPR length "0x${CMAKE_MATCH_4}${CMAKE_MATCH_3}${CMAKE_MATCH_2}${CMAKE_MATCH_1}")
    file(READ "${asset}" json OFFSET 20 LIMIT ${length})
  elseif(head MATCHES "^(20|09|0a|0d)*7b") # a brace; streams begin with a letter
    file(READ "${asset}" json)
  endif()
  set(${out} "${json}" PARENT_SCOPE)
endfunction()

# Sets OUT to a relative URI as the path it stands for: %20 is a space.
function(decode_uri out uri)
  set(path "")
  while(uri MATCHES "^([^%]*)%([0-9A-Fa-f][0-9A-Fa-f])(.*)$")
    math(EXPR code "0x${CMAKE_MATCH_2}")
    set(before "${CMAKE_MATCH_1}")
    set(uri "${CMAKE_MATCH_3}")
    string(ASCII ${code} character)
    string(APPEND path "${before}${character}")
  endwhile()
  set(${out} "${path}${uri}" PARENT_SCOPE)
endfunction()

# Appends to the list OUT the files that the elements of an array of the JSON name: buffers, images.
function(append_named_files out asset json array)
  string(JSON count ERROR_VARIABLE absent LENGTH "${json}" ${array})
  if(absent OR count EQUAL 0)
    return()
  endif()
  cmake_path(GET asset PARENT_PATH folder)
  math(EXPR last "${count} - 1")
  foreach(i RANGE ${last})
    string(JSON uri ERROR_VARIABLE absent GET "${json}" ${array} ${i} uri)
    if(NOT absent AND NOT uri MATCHES "^[A-Za-z][A-Za-z0-9+.-]*:") # data:, https:
      decode_uri(file "${uri}")
      cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${folder}" NORMALIZE)
      list(APPEND ${out} "${file}")
    endif()
  endforeach()
  set(${out} "${${out}}" PARENT_SCOPE)
endfunction()

# Sets OUT to a path as Make reads it.
function(escape out path)
  string(REPLACE "$" "$$" path "${path}")
  string(REGEX REPLACE "([ #])" "\\\\\\1" path "${path}")
  set(${out} "${path}" PARENT_SCOPE)
endfunction()

set(files "${CMAKE_CURRENT_LIST_FILE}") # Ninja takes an empty list for a missing one
foreach(asset IN LISTS ASSETS)
  read_json(json "${asset}")
  append_named_files(files "${asset}" "${json}" buffers)
  append_named_files(files "${asset}" "${json}" images)
endforeach()
list(REMOVE_DUPLICATES files)

escape(rule "${STAMP}")
string(APPEND rule ":")
foreach(file IN LISTS files)
  escape(escaped "${file}")
  string(APPEND rule " ${escaped}")
endforeach()
file(WRITE "${STAMP}.d" "${rule}\n")
file(WRITE "${STAMP}" "")
