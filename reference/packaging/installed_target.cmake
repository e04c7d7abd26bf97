# contactcheck_installed_target(NAME)
# Puts contactcheck_NAME into the export set and package of its layer, core or reference, under the
# name that users link: contactcheck::NAME.
function(contactcheck_installed_target name)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REGEX MATCH "^[a-z]+" layer ${folder})
  set_target_properties(contactcheck_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS contactcheck_${name} EXPORT contactcheck-${layer}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  # In the order of the folders, which is that of dependencies: for pkg-config.
  get_target_property(type contactcheck_${name} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    set_property(GLOBAL APPEND PROPERTY CONTACTCHECK_${layer}_LIBRARIES contactcheck_${name})
  endif()
endfunction()
