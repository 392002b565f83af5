# cmake --install BUILD --prefix P: P/bin/sus, P/lib/tushar with the modules, P/include/tushar, and what
# find_package(Tushar) reads. P may be moved afterwards.
include(CMakePackageConfigHelpers)

set_target_properties(tushar_core PROPERTIES EXPORT_NAME core INSTALL_RPATH "$ORIGIN")
set_target_properties(tushar_options PROPERTIES EXPORT_NAME options)
set_target_properties(sus PROPERTIES INSTALL_RPATH "$ORIGIN/../lib/tushar")
install(TARGETS tushar_core tushar_options sus EXPORT Tushar RUNTIME DESTINATION bin LIBRARY DESTINATION lib/tushar)
install(TARGETS tushar_petsc LIBRARY DESTINATION lib/tushar)
install(FILES ${CMAKE_BINARY_DIR}/modules/index.txt DESTINATION lib/tushar/modules)
install(FILES LICENSE DESTINATION share/doc/tushar RENAME copyright)

# Headers: all but those that read headers of MPI, HDF5 and PETSc, which no component does, and that of all components.
install(DIRECTORY core components DESTINATION include/tushar FILES_MATCHING PATTERN *.hpp
        PATTERN core/base/mpi_native.hpp EXCLUDE PATTERN core/output/archive_hdf5_handles.hpp EXCLUDE
        PATTERN core/output/shared_hdf5.hpp EXCLUDE
        PATTERN core/collect/stored_state.hpp EXCLUDE PATTERN core/solvers/petsc* EXCLUDE
        PATTERN components/components.hpp EXCLUDE)
install(FILES tests/support/levels.hpp tests/support/particles.hpp tests/support/run.hpp
        DESTINATION include/tushar/tests/support)

set(package lib/cmake/Tushar)
install(EXPORT Tushar NAMESPACE Tushar:: FILE TusharTargets.cmake DESTINATION ${package})
configure_package_config_file(tools/lib/TusharConfig.cmake.in ${CMAKE_BINARY_DIR}/TusharConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/TusharConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/TusharConfig.cmake ${CMAKE_BINARY_DIR}/TusharConfigVersion.cmake
        tools/lib/tushar_module.cmake tools/lib/module_card.cpp.in DESTINATION ${package})

# cpack --preset package: a Debian package for machines with the libraries of this one.
set(CPACK_PACKAGE_NAME tushar)
set(CPACK_PACKAGE_CONTACT "the Tushar project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "parallel particle and grid simulation: sus, components, headers")
if(TUSHAR_PROCESSOR)
  set(CPACK_PACKAGE_DESCRIPTION "It needs a processor with the instructions of ${TUSHAR_PROCESSOR}.")
endif()
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR} ${CMAKE_BINARY_DIR}/modules)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, libeigen3-dev, libfmt-dev, libpugixml-dev, libgtest-dev")
include(CPack)
