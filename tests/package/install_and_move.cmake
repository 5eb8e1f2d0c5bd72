# Installs a build and moves what was installed, so that a path of the build or of the first prefix
# in it would show: cmake -DBUILD=folder -DPREFIX=folder -P install_and_move.cmake
file(REMOVE_RECURSE ${PREFIX} ${PREFIX}.first)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}.first
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${PREFIX}.first ${PREFIX})
file(GLOB_RECURSE texts ${PREFIX}/*.cmake ${PREFIX}/*.pc ${PREFIX}/*.h ${PREFIX}/*.hpp)
foreach(text ${texts})
  file(READ ${text} content)
  foreach(folder ${BUILD} ${PREFIX}.first)
    string(FIND "${content}" "${folder}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${text} names ${folder}, so the package cannot be moved")
    endif()
  endforeach()
endforeach()
