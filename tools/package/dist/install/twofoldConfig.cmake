# Targets twofold::twofold_f64 and twofold::twofold_f32, found from where this
# file lies, so that the installed tree can be moved.
get_filename_component(_twofold_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.."
  ABSOLUTE)
foreach(_twofold_real f64 f32)
  set(_twofold_target twofold::twofold_${_twofold_real})
  if(NOT TARGET ${_twofold_target})
    add_library(${_twofold_target} STATIC IMPORTED)
    set_target_properties(${_twofold_target} PROPERTIES
      IMPORTED_LOCATION "${_twofold_prefix}/lib/libtwofold_${_twofold_real}.a"
      IMPORTED_LINK_INTERFACE_LANGUAGES C
      INTERFACE_INCLUDE_DIRECTORIES "${_twofold_prefix}/include"
      INTERFACE_LINK_LIBRARIES m)
  endif()
endforeach()
set_target_properties(twofold::twofold_f32 PROPERTIES
  INTERFACE_COMPILE_DEFINITIONS TF_REAL_FLOAT)
