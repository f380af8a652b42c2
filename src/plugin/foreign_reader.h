// Readers of images that the program does not hold: of a shared library (library.h), as kinds of a
// PointReaderSet. Scenarios add them (plugin_use.h).
#pragma once

#include "perception/point_reader.h"
#include "perception/point_reader_set_params.h"
#include "plugin/foreign_source.h"

namespace rockyard::plugin {

// Where readers of one kind come from. Shared by all copies of the kind; any thread may call it.
class ReaderSource : public CheckedSource<perception::PointReader, perception::PointReaderSetup> {
 public:
  using CheckedSource::CheckedSource;
};

// A kind of such readers, with its parameters.
class ForeignReaderKind final
    : public CheckedKind<ForeignReaderKind, perception::PointReaderKind, ReaderSource,
                         perception::PointReader, perception::PointReaderSetup> {
 public:
  using CheckedKind::CheckedKind;
};

}  // namespace rockyard::plugin
