/// \file
/// Measurements that need a fresh process: peak memory, and the time from start to first result.
#pragma once

#include <string>
#include <vector>

#include "bench/turns.hpp"

namespace powercell::bench {

/// Records the peak memory of each contender of `options` at the work, each in its own process: runs this
/// program
/// (`self`) with the subcommand "memory-child".
void record_memory(const std::string& self, const Work& work, const TurnOptions& options, RecordFile& file);
/// That subcommand: prints the peak memory while the contender runs, bytes per seed beyond input and output.
/// \param way "stage:provider"   \throw std::runtime_error if the peak cannot be read
void memory_child(const Work& work, const std::string& way, const TurnOptions& options);

/// Times runs of `program`, each a fresh process, after a first one that fills the kernel cache.
void record_start(const std::string& program, const TurnOptions& options, RecordFile& file);
/// Times runs with empty kernel caches. \param stage  of the record
/// \param words  the program and its arguments, followed by an empty folder if the last one is "-o"
void record_cold(const std::string& stage, std::vector<std::string> words, const TurnOptions& options,
                 RecordFile& file);

}  // namespace powercell::bench
