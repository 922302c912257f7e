// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/codes/code_run.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>

#include "harness/codes/assess_snapshot.hpp"
#include "harness/codes/child_process.hpp"
#include "harness/codes/external_code.hpp"
#include "harness/codes/initial_snapshot.hpp"
#include "harness/codes/read_snapshot.hpp"
#include "harness/run/clock.hpp"
#include "harness/scene/place.hpp"
#include "reports/json/results_json.hpp"
#include "reports/printable.hpp"

namespace sphverify {

namespace {

namespace fs = std::filesystem;

constexpr std::streamoff kept_output = 4096;     // of what a command printed, its end
constexpr std::size_t longest_line = 200;

/// A new folder in the place for what is temporary, which goes when this does.
class WorkFolder {
 public:
  WorkFolder(std::string const& keep, std::string const& run) : is_kept_(!keep.empty()) {
    std::error_code ignored;
    if (is_kept_) fs::create_directories(keep, ignored);
    std::string pattern = fs::absolute((is_kept_ ? fs::path(keep) : fs::temp_directory_path()) / ("sphverify-" + run + "-XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error(fmt::format("{}: {}", pattern, std::strerror(errno)));
    path_ = pattern;
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (!is_kept_) fs::remove_all(path_, ignored);
  }
  WorkFolder(WorkFolder const&) = delete;
  WorkFolder& operator=(WorkFolder const&) = delete;

  std::string in(std::string const& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  bool is_kept_;
  fs::path path_;
};

std::string extension(std::string const& format) { return format == "csv" || format == "auto" ? "csv" : "hdf5"; }

void replace_all(std::string& text, std::string const& what, std::string const& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// The end of what a command printed.
std::string output_of(std::string const& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "";  // whatever the command has made of it
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::streamoff const size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
  std::string text(static_cast<std::size_t>(std::min(size, kept_output)), '\0');
  file.seekg(size - static_cast<std::streamoff>(text.size()));
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  std::string line = printable(text.substr(text.rfind('\n') + 1));
  if (line.size() <= longest_line) return line;
  std::size_t from = line.size() - longest_line;
  while (from < line.size() && (static_cast<unsigned char>(line[from]) & 0xC0) == 0x80) ++from;  // within a character
  return "..." + line.substr(from);
}

/// Output as text that a document can hold, its lines kept.
std::string as_document_text(std::string const& output) {
  std::string text;
  for (std::size_t from = 0; from < output.size();) {
    std::size_t const to = std::min(output.find('\n', from), output.size());
    text += printable(output.substr(from, to - from)) + (to < output.size() ? "\n" : "");
    from = to + 1;
  }
  return text;
}

/// Which run a folder is of: "pysph-N64-seed2".
std::string name_of(RunSpec const& spec) {
  std::string const name = spec.formulation.id.substr(std::string(external_prefix).size());
  std::uint64_t const seed = spec.discretisation.layout.seed;
  return fmt::format("{}-N{}{}", name, spec.resolution, seed > 0 ? fmt::format("-seed{}", seed) : "");
}

/// One start of the command with all that it needs.
class CodeStart {
 public:
  CodeStart(AnyProblem const& problem, RunSpec const& spec, RunOptions const& options)
      : problem_(problem), spec_(spec), options_(options), code_(*spec.code), folder_(code_.keep, name_of(spec)) {
    initial_ = initial_snapshot(spec.scene_case->info.kind, problem, spec.discretisation, spec.resolution, spec.smoothing_ratio);
    initial_.file = folder_.in("initial." + extension(code_.initial));
    write_initial_particles(initial_.file, code_.initial, initial_, problem, spec.discretisation);
    write_document(initial_.file + ".case.json",
                   document_text(case_sheet(*spec.scene_case, spec.parameters, problem, spec.discretisation, spec.resolution,
                                            spec.smoothing_ratio)));
  }

  Snapshot const& initial() const { return initial_; }
  std::string final_file() const { return folder_.in("final." + extension(code_.options.format)); }
  std::string output() const { return output_of(folder_.in("output.txt")); }
  std::string hint() const { return code_.keep.empty() ? "" : " (" + folder_.path() + ")"; }

  /// @param spent_seconds of the time budget, before it
  ChildOutcome run(double spent_seconds) const {
    ChildCommand command;
    command.words = words();
    command.folder = folder_.path();
    command.output = folder_.in("output.txt");
    command.environment = {{"OMP_NUM_THREADS", std::to_string(options_.threads)}};
    if (options_.time_budget > 0.0) command.seconds = std::max(1e-3, options_.time_budget - spent_seconds);
    command.bytes = static_cast<std::uint64_t>(1e9 * code_.disk_budget);
    command.interrupted = options_.interrupted;
    ChildOutcome const outcome = run_child(command);
    if (outcome.end == ChildOutcome::End::interrupted) throw Interrupted();
    return outcome;
  }

 private:
  std::vector<std::string> words() const {
    double const end = std::visit([](auto const& p) { return p.final_time; }, problem_);
    std::pair<char const*, std::string> const values[] = {
        {"{initial}", initial_.file},
        {"{final}", final_file()},
        {"{case}", initial_.file + ".case.json"},
        {"{time}", fmt::format("{}", end)},
        {"{resolution}", std::to_string(spec_.resolution)},
        {"{seed}", std::to_string(spec_.discretisation.layout.seed)},
        {"{threads}", std::to_string(options_.threads)},
        {"{here}", fs::current_path().string()}};
    std::vector<std::string> words = code_.command;
    for (std::string& word : words) {
      for (auto const& [name, value] : values) replace_all(word, name, value);
    }
    return words;
  }

  AnyProblem const& problem_;
  RunSpec const& spec_;
  RunOptions const& options_;
  ExternalCode const& code_;
  WorkFolder folder_;
  Snapshot initial_;
};

/// Why a command's end is none; empty for a good one.
std::string why_failed(ChildOutcome const& outcome, ExternalCode const& code, double time_budget) {
  using End = ChildOutcome::End;
  switch (outcome.end) {
    case End::exited:
      return outcome.status == 0 ? "" : fmt::format("the command ended with status {}", outcome.status);
    case End::signalled:
      return fmt::format("the command was ended by signal {} ({})", outcome.status, strsignal(outcome.status));
    case End::not_started:
      return fmt::format("{} cannot be started: {}", code.command.front(), std::strerror(outcome.status));
    case End::out_of_time:
      return fmt::format("the command had not ended within the time budget of {:g} s", time_budget);
    case End::out_of_space:
      return fmt::format("the command wrote more than its disk_budget of {:g} GB", code.disk_budget);
    case End::interrupted:
      break;
  }
  return "";
}

Cost cost_of(ChildOutcome const& outcome) {
  Cost cost;
  cost.seconds = outcome.seconds;
  cost.cpu_seconds = outcome.cpu_seconds;
  cost.peak_bytes = outcome.peak_bytes;
  return cost;
}

}  // namespace

void run_code(AnyProblem const& problem, RunSpec const& spec, RunOptions const& options, MeasuredRun& run) {
  Clock const clock;
  RunRecord& record = run.record;
  std::unique_ptr<CodeStart> made;
  try {
    made = std::make_unique<CodeStart>(problem, spec, options);
  } catch (std::runtime_error const& error) {
    record.status = "failed";
    record.reason = fmt::format("its particles cannot be written: {}", error.what());
    return;
  }
  CodeStart const& start = *made;
  record.particles = start.initial().size();
  record.spacing = std::visit(
      [&](auto const& p) { return spacing_of(p.domain, spec.discretisation.layout, spec.resolution); }, problem);
  record.smoothing_length = spec.smoothing_ratio * record.spacing;
  ChildOutcome const outcome = start.run(0.0);
  std::string const output = start.output();
  record.output = as_document_text(output);
  std::string const said = last_line(output);
  auto const fail = [&](std::string const& why) {
    record.status = "failed";
    record.reason = why + (said.empty() ? "" : "; its last line: " + said) + start.hint();
  };
  run.spent_seconds = clock.seconds();
  if (std::string const why = why_failed(outcome, *spec.code, options.time_budget); !why.empty())
    return fail(why);
  std::error_code ignored;
  if (!fs::is_regular_file(start.final_file(), ignored)) return fail("the command wrote no {final}");
  try {
    Snapshot last = read_snapshot({start.final_file()}, spec.code->options);
    last.file = "{final}";
    AssessedCase const one{spec.scene_case, problem, spec.discretisation, spec.resolution, spec.smoothing_ratio};
    assess_snapshots(one, {start.initial(), std::move(last)}, spec.code->options, options.measure, record);
  } catch (UserError const& error) {
    std::string why = error.what();
    replace_all(why, start.final_file(), "{final}");
    return fail(why);
  } catch (std::bad_alloc const&) {
    return fail("{final} does not fit into memory");
  }
  if (record.status != "ok" || !options.measure.contains(Measure::cost)) return;
  RepeatRule const& rule = options.repeat;
  bool const once_is_enough = rule.most == 1 || (rule.seconds > 0.0 && outcome.seconds >= rule.seconds) ||
                              (options.time_budget > 0.0 && clock.seconds() > 0.5 * options.time_budget);
  record.cost = time_repeats({}, [&] { return std::optional(cost_of(outcome)); }, [] { return false; });
  record.cost->warm_up = false;
  run.awaits_timing = !once_is_enough;
  run.spent_seconds = clock.seconds();
}

Repetition repeat_code(AnyProblem const& problem, RunSpec const& spec, RunOptions const& options) {
  return [&problem, &spec, &options](double spent_seconds) -> std::optional<Cost> {
    std::unique_ptr<CodeStart> start;
    try {
      start = std::make_unique<CodeStart>(problem, spec, options);
    } catch (std::runtime_error const&) {
      return std::nullopt;
    }
    ChildOutcome const outcome = start->run(spent_seconds);
    if (outcome.end != ChildOutcome::End::exited || outcome.status != 0) return std::nullopt;
    return cost_of(outcome);
  };
}

}  // namespace sphverify
