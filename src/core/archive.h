// The JSON side of parameter structs in one include: reads, writes, lists and describes anything
// that has `void Visit(core::FieldVisitor&)`. Scenarios and sweeps, the files of tools and
// conditions that try a parameter out use it.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/field_archive.h"
#include "core/field_table.h"
#include "core/json_value.h"

namespace rockyard::core {

// Reads the fields that `json` states into `params`; the others keep their values. Throws UserError
// with every problem; `params` is then partly read. `others` are keys of `json` that another reader
// takes.
template <typename Params>
void ReadParams(const JsonValue& json, Params& params,
                std::initializer_list<std::string_view> others = {}) {
  FieldReader reader(json, others);
  params.Visit(reader);
  reader.Finish();
}

// Returns every field of `params`, as a JSON object.
template <typename Params>
JsonValue WriteParams(Params params) {
  FieldWriter writer;
  params.Visit(writer);
  return writer.Take();
}

// Returns the fields of `params` with all that is known of them.
template <typename Params>
FieldTable ListParams(Params params = {}) {
  FieldTable table;
  params.Visit(table);
  return table;
}

// Returns the JSON Schema of a parameter struct; its defaults are those of `Params{}`.
template <typename Params>
JsonValue SchemaOf(std::string_view title) {
  return MakeSchema(ListParams<Params>(), title);
}

}  // namespace rockyard::core
