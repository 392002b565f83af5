# tushar_module(NAME [TOGETHER] SOURCES FILE... [ALONE FILE...] [CALM FILE...] [COMPONENTS NAME...]
#               [ANALYSES NAME...] [NEEDS MODULE...])
#
# A module: a shared library that sus loads when a scene names one of its components or analyses. One of the sources
# defines `tushar::simulation::Catalogue tushar::modules::NAME()`, which returns them; it is called once. NEEDS names
# modules whose functions this one calls. With TOGETHER, all sources except ALONE are compiled as one, which is faster.
# CALM names sources that read scenes and are never hot; in Tushar's own build they are compiled with fewer
# optimisations.
# The library is the target tushar_NAME; its objects alone, with which tests link, are tushar_NAME_objects.
set(TUSHAR_CARD ${CMAKE_CURRENT_LIST_DIR}/module_card.cpp.in)

function(tushar_module name)
  cmake_parse_arguments(PARSE_ARGV 1 module "TOGETHER" "" "SOURCES;ALONE;CALM;COMPONENTS;ANALYSES;NEEDS")
  if(NOT module_SOURCES OR module_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tushar_module(${name}): found '${module_UNPARSED_ARGUMENTS}'; expected SOURCES FILE...")
  endif()
  list(TRANSFORM module_NEEDS PREPEND Tushar::)
  set(parts tushar_${name}_objects)
  if(module_CALM AND TARGET tushar_precompiled_calm)
    list(REMOVE_ITEM module_SOURCES ${module_CALM})
    list(APPEND parts tushar_${name}_calm)
    add_library(tushar_${name}_calm OBJECT ${module_CALM})
    set_target_properties(tushar_${name}_calm PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD ON
                          UNITY_BUILD_BATCH_SIZE 0)
    target_link_libraries(tushar_${name}_calm PUBLIC Tushar::core)
    target_compile_options(tushar_${name}_calm PRIVATE ${calm_options}
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    target_precompile_headers(tushar_${name}_calm REUSE_FROM tushar_precompiled_calm)
  endif()
  add_library(tushar_${name}_objects OBJECT ${module_SOURCES})
  set_target_properties(tushar_${name}_objects PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(tushar_${name}_objects PUBLIC Tushar::core)
  if(module_TOGETHER AND TUSHAR_PRECOMPILE)
    set_target_properties(tushar_${name}_objects PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    set_source_files_properties(${module_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    # GCC takes each source here for a header, in which unnamed namespaces would be a mistake.
    target_compile_options(tushar_${name}_objects PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(TARGET tushar_precompiled)
    target_precompile_headers(tushar_${name}_objects REUSE_FROM tushar_precompiled)
  endif()
  set(TUSHAR_MODULE ${name})
  configure_file(${TUSHAR_CARD} ${CMAKE_CURRENT_BINARY_DIR}/${name}_card.cpp @ONLY)
  add_library(tushar_${name} SHARED ${CMAKE_CURRENT_BINARY_DIR}/${name}_card.cpp)
  add_library(Tushar::${name} ALIAS tushar_${name})
  target_link_libraries(tushar_${name} PRIVATE ${parts} ${module_NEEDS})
  # The card is compiled like the sources, so that it tells sus about the flags that a repository gave to them alone.
  foreach(flags OPTIONS DEFINITIONS)
    set_property(TARGET tushar_${name} APPEND PROPERTY COMPILE_${flags}
                 $<TARGET_PROPERTY:tushar_${name}_objects,COMPILE_${flags}>)
  endforeach()
  target_link_options(tushar_${name} PRIVATE -Wl,-z,defs -Wl,-Bsymbolic-functions)
  set_target_properties(tushar_${name} PROPERTIES PREFIX "" EXPORT_NAME ${name} BUILD_RPATH "$ORIGIN;$ORIGIN/.."
    INSTALL_RPATH "$ORIGIN;$ORIGIN/..")
  set_property(GLOBAL APPEND PROPERTY tushar_modules ${name})
  set_property(GLOBAL APPEND PROPERTY tushar_parts ${parts})
  foreach(component IN LISTS module_COMPONENTS)
    set_property(GLOBAL APPEND PROPERTY tushar_index "${name} component ${component}")
  endforeach()
  foreach(analysis IN LISTS module_ANALYSES)
    set_property(GLOBAL APPEND PROPERTY tushar_index "${name} analysis ${analysis}")
  endforeach()
endfunction()
