# What `cmake --install` and `cpack` take: the program with its manual, completions and examples
# (component program), and every module as a library with its headers (component development).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(headers "${CMAKE_INSTALL_INCLUDEDIR}/flowslide")
set(package "${CMAKE_INSTALL_LIBDIR}/cmake/flowslide")

# The libraries of a folder and of those below it, but for tests.
function(list_modules folder result)
  get_directory_property(below DIRECTORY "${folder}" SUBDIRECTORIES)
  get_directory_property(here DIRECTORY "${folder}" BUILDSYSTEM_TARGETS)
  set(found)
  foreach(target IN LISTS here)
    get_target_property(type ${target} TYPE)
    if(target MATCHES "^flowslide_" AND type MATCHES "STATIC_LIBRARY|INTERFACE_LIBRARY"
       AND NOT target MATCHES "_(warnings|catch_main)$")
      string(REGEX REPLACE "^flowslide_" "" short ${target})
      set_target_properties(${target} PROPERTIES EXPORT_NAME ${short})
      list(APPEND found ${target})
    endif()
  endforeach()
  list(FILTER below EXCLUDE REGEX "^${PROJECT_SOURCE_DIR}/tests/")
  foreach(subfolder IN LISTS below)
    list_modules("${subfolder}" more)
    list(APPEND found ${more})
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

list_modules("${PROJECT_SOURCE_DIR}" libraries)
install(TARGETS ${libraries} EXPORT flowslide COMPONENT development
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}/flowslide" COMPONENT development)
install(EXPORT flowslide NAMESPACE flowslide:: FILE flowslideTargets.cmake
        DESTINATION "${package}" COMPONENT development)
set(with_headers ${modules})
list(REMOVE_ITEM with_headers cli)
foreach(module IN LISTS with_headers)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${module}" DESTINATION "${headers}" COMPONENT development
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
configure_package_config_file(cmake/flowslideConfig.cmake.in flowslideConfig.cmake
                              INSTALL_DESTINATION "${package}")
write_basic_package_version_file(flowslideConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/flowslideConfig.cmake"
              "${PROJECT_BINARY_DIR}/flowslideConfigVersion.cmake"
        DESTINATION "${package}" COMPONENT development)

if(TARGET flowslide)
  install(TARGETS flowslide RUNTIME COMPONENT program)
  # The program writes what describes it, so none of it can be of another version.
  set(described)
  foreach(kind bash zsh man)
    set(file "${PROJECT_BINARY_DIR}/share/flowslide.${kind}")
    add_custom_command(OUTPUT "${file}" DEPENDS flowslide VERBATIM
      COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/share"
      COMMAND flowslide completion ${kind} > "${file}")
    list(APPEND described "${file}")
  endforeach()
  add_custom_target(flowslide_described ALL DEPENDS ${described})
  set(share "${PROJECT_BINARY_DIR}/share/flowslide")
  install(FILES "${share}.man" RENAME flowslide.1
          DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
  install(FILES "${share}.bash" RENAME flowslide
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT program)
  # Debian's zsh looks for those of packages and for those of /usr/local in different folders.
  set(zsh site-functions)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(zsh vendor-completions)
  endif()
  install(FILES "${share}.zsh" RENAME _flowslide
          DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/${zsh}" COMPONENT program)
  # Beside each other as in the checkout: the workflows name the fixtures by relative paths.
  install(DIRECTORY workflows DESTINATION "${CMAKE_INSTALL_DATADIR}/flowslide" COMPONENT program
          FILES_MATCHING PATTERN "*.yaml" PATTERN "*.csv" PATTERN engine EXCLUDE PATTERN stages EXCLUDE)
  install(DIRECTORY fixtures/opensees DESTINATION "${CMAKE_INSTALL_DATADIR}/flowslide/fixtures"
          COMPONENT program)
endif()
install(FILES README.md CHANGELOG.md LICENSE CITATION.cff
        DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the flowslide authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME flowslide)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib, python3-numpy")
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/cmake/Package.cmake")
set(CPACK_FLOWSLIDE_ARCH "${FLOWSLIDE_ARCH}")
include(CPack)
