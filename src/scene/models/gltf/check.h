#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace airlight::gltf {

using Json = nlohmann::json;

/// Parses the JSON of a glTF file. Throws Error with line and column if it is none, or nested
/// deeper than any model is.
Json parse_json(std::string_view text, const std::string& file);

/// Holds a document to what is read of it: every type, range and length, and that each index names
/// something. The parser that comes after takes wrong types for absent ones and does not look at
/// indices. Throws Error that says where.
void check_document(const Json& document, const std::string& file);

/// The extensions that a checked document uses and nobody here reads.
std::vector<std::string> extensions_left_out(const Json& document);

}  // namespace airlight::gltf
