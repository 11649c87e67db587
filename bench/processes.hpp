/// \file
/// What only a fresh process can tell: peak memory, and the time from start to first result.
#pragma once

#include <string>

#include "bench/turns.hpp"

namespace powercell::bench {

/// Peak memory of each contender of `options` at the work, each in a process of its own: this program
/// (`self`) is started again with the word "memory-child".
void record_memory(const std::string& self, const Work& work, const TurnOptions& options, RecordFile& file);
/// Such a process: prints bytes per seed beyond input and output, reached while the contender ran.
/// \param way "stage:provider"   \throw std::runtime_error where the peak cannot be read
void memory_child(const Work& work, const std::string& way, const TurnOptions& options);

/// Times `program`, a fresh process each time, after a first run that fills the kernel cache.
void record_start(const std::string& program, const TurnOptions& options, RecordFile& file);

}  // namespace powercell::bench
