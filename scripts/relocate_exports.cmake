# The ROS 2 packages on the Python package index were built in a container whose Python and numpy
# folders are recorded, as absolute paths, in their CMake exports; CMake refuses targets that name
# missing folders. Included into every project through CMAKE_PROJECT_INCLUDE, this file replaces
# such entries by what is found on this machine. Entries that exist are left alone, so under an
# ordinarily installed ROS nothing changes.

include_guard(GLOBAL)

function(tlcomm_relocate_exports)
  find_package(Python3 QUIET COMPONENTS Interpreter Development.Module NumPy)
  get_property(targets DIRECTORY PROPERTY IMPORTED_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(folders "${target}" INTERFACE_INCLUDE_DIRECTORIES)
    if(NOT folders)
      continue()
    endif()
    set(relocated "")
    foreach(folder IN LISTS folders)
      if(folder MATCHES "^/opt/python/" AND NOT IS_DIRECTORY "${folder}")
        if(folder MATCHES "numpy")
          list(APPEND relocated ${Python3_NumPy_INCLUDE_DIRS})
        else()
          list(APPEND relocated ${Python3_INCLUDE_DIRS})
        endif()
      else()
        list(APPEND relocated "${folder}")
      endif()
    endforeach()
    if(NOT relocated STREQUAL folders)
      list(REMOVE_DUPLICATES relocated)
      set_target_properties("${target}" PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${relocated}")
    endif()
  endforeach()
endfunction()

# Deferred, since the targets are imported only after project().
cmake_language(DEFER CALL tlcomm_relocate_exports)
