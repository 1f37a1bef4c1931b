# airlight_wide_object(<name> <source> [TARGET <target>] FLAGS <flag>…)
#
# Compiles one source of a target (library `airlight` unless told otherwise) for a wider instruction set
# and hides every symbol of the object but its entry, `airlight_<name>` (declare it extern "C"). Without
# this the linker would merge inline functions and templates, ours or std's, of wide and baseline
# objects, and could put AVX-512 code in the path of a machine that has none.
#
# `ld -r --force-group-allocation` dissolves the COMDAT groups, so that nothing is left to merge;
# `objcopy --keep-global-symbol` makes every other definition local. tests/wide_objects.sh checks both.
function(airlight_wide_object name source)
  cmake_parse_arguments(PARSE_ARGV 2 wide "" "TARGET" "FLAGS")
  if(NOT wide_TARGET)
    set(wide_TARGET airlight)
  endif()
  set(entry airlight_${name})
  set(compiled wide_${name})
  set(merged ${CMAKE_CURRENT_BINARY_DIR}/${name}.merged.o)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.wide.o)

  # A library of its own sees what the target sees, but cannot link to it: the target is made of it.
  add_library(${compiled} OBJECT ${source})
  set_target_properties(${compiled} PROPERTIES
    POSITION_INDEPENDENT_CODE ON INTERPROCEDURAL_OPTIMIZATION OFF)
  target_link_libraries(${compiled} PRIVATE $<TARGET_PROPERTY:${wide_TARGET},LINK_LIBRARIES>)
  target_include_directories(${compiled} PRIVATE $<TARGET_PROPERTY:${wide_TARGET},INCLUDE_DIRECTORIES>)
  target_compile_definitions(${compiled} PRIVATE $<TARGET_PROPERTY:${wide_TARGET},COMPILE_DEFINITIONS>)
  # gcc 12 warns of its own AVX-512 intrinsics, whose undefined values are meant (gcc bug 105593).
  target_compile_options(${compiled} PRIVATE -fno-gnu-unique -Wno-uninitialized -Wno-maybe-uninitialized ${wide_FLAGS})

  add_custom_command(OUTPUT ${object}
    COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${merged} $<TARGET_OBJECTS:${compiled}>
    COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=${entry} ${merged} ${object}
    COMMAND ${CMAKE_COMMAND} -E rm ${merged}
    DEPENDS $<TARGET_OBJECTS:${compiled}>
    COMMENT "Hiding all but ${entry} of ${name}" VERBATIM)
  add_custom_target(${compiled}_object DEPENDS ${object})

  # The property lets the target, which may live in another folder, take the object as it is.
  set_source_files_properties(${object} TARGET_DIRECTORY ${wide_TARGET} PROPERTIES
    EXTERNAL_OBJECT ON GENERATED ON)
  target_sources(${wide_TARGET} PRIVATE ${object})
  add_dependencies(${wide_TARGET} ${compiled}_object)
  set_property(GLOBAL APPEND PROPERTY AIRLIGHT_WIDE_OBJECTS "${entry}=${object}")
endfunction()
