// The JSON side of parameter structs in one include: read, write, list and describe anything that
// has `void Visit(core::FieldVisitor&)`.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/field_archive.h"
#include "core/field_table.h"
#include "core/json_value.h"

namespace rockyard::core {

// Reads what `json` gives over the present values of `params`. Throws UserError with every problem;
// `params` is then partly read. `others` are keys beside these that somebody else reads.
template <typename Params>
void ReadParams(const JsonValue& json, Params& params,
                std::initializer_list<std::string_view> others = {}) {
  FieldReader reader(json, others);
  params.Visit(reader);
  reader.Finish();
}

// Every field of `params`.
template <typename Params>
JsonValue WriteParams(Params params) {
  FieldWriter writer;
  params.Visit(writer);
  return writer.Take();
}

// The fields of `params` with all that is known of them.
template <typename Params>
FieldTable ListParams(Params params = {}) {
  FieldTable table;
  params.Visit(table);
  return table;
}

// JSON Schema of a parameter struct.
template <typename Params>
JsonValue SchemaOf(std::string_view title) {
  return MakeSchema(ListParams<Params>(), title);
}

}  // namespace rockyard::core
