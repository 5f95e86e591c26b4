# mapproof_embed_resources(TARGET FUNCTION ROOT FILE...)
#
# Embeds files in TARGET. `std::span<const mapproof::Resource> FUNCTION()` (declare it in a header
# of the target) returns them, sorted, each with its path relative to ROOT.
function(mapproof_embed_resources target function root)
  set(files ${ARGN})
  list(SORT files)
  set(assembly "${CMAKE_CURRENT_BINARY_DIR}/${function}.embedded.S")
  set(table "${CMAKE_CURRENT_BINARY_DIR}/${function}.embedded.cpp")
  set(asm_text "  .section .rodata\n")
  set(declarations "")
  set(rows "")
  set(index 0)
  foreach(file IN LISTS files)
    cmake_path(RELATIVE_PATH file BASE_DIRECTORY "${root}" OUTPUT_VARIABLE name)
    set(symbol "mapproof_${function}_${index}")
    string(APPEND asm_text
      "  .balign 16\n  .global ${symbol}_begin\n${symbol}_begin:\n  .incbin \"${file}\"\n"
      "  .global ${symbol}_end\n${symbol}_end:\n  .byte 0\n")
    string(APPEND declarations
      "extern \"C\" const char ${symbol}_begin[];\nextern \"C\" const char ${symbol}_end[];\n")
    string(APPEND rows
      "      Resource{\"${name}\", {${symbol}_begin, ${symbol}_end}},\n")
    math(EXPR index "${index} + 1")
  endforeach()
  string(APPEND asm_text "  .section .note.GNU-stack,\"\",%progbits\n")
  file(CONFIGURE OUTPUT "${assembly}" CONTENT "${asm_text}" @ONLY)
  file(CONFIGURE OUTPUT "${table}" CONTENT "#include <array>\n#include <span>
#include \"core/base/resource.hpp\"\n
${declarations}
namespace mapproof {\n
std::span<const Resource> ${function}() {
  static const std::array<Resource, ${index}> table = {{
${rows}  }};
  return table;
}\n
}  // namespace mapproof\n" @ONLY)
  set_source_files_properties("${assembly}" PROPERTIES OBJECT_DEPENDS "${files}")
  target_sources(${target} PRIVATE "${assembly}" "${table}")
endfunction()
