// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/run_study.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <thread>
#include <type_traits>

#include "formulations/basics/fork_join.hpp"
#include "harness/measure/machine.hpp"
#include "harness/measure/series.hpp"
#include "harness/measure/surface.hpp"
#include "harness/study/available_memory.hpp"
#include "harness/study/carry_out.hpp"
#include "harness/study/context.hpp"
#include "harness/study/expand.hpp"
#include "harness/study/expected_work.hpp"
#include "harness/study/fingerprint.hpp"
#include "harness/study/journal.hpp"
#include "harness/study/memory.hpp"
#include "harness/study/parts.hpp"
#include "harness/study/pending_runs.hpp"
#include "harness/study/progress.hpp"
#include "harness/study/say.hpp"
#include "harness/study/shared_study.hpp"
#include "reports/json/results_json.hpp"
#include "reports/write_results.hpp"

namespace sphverify {

namespace {

/// How many of the largest runs fit into memory together.
int jobs_that_fit(Expansion const& expansion) {
  double largest = 0.0;
  for (RunSpec const& run : expansion.runs) {
    AnyProblem const problem = run.scene_case->problem(run.parameters);
    double const support = support_of(run);
    double const bytes =
        estimated_bytes(run.scene_case->info.kind, run.discretisation.integrator, problem, run.discretisation.layout, run.resolution, support) +
        bytes_of_weights(run.formulation, problem, run.discretisation.layout, run.resolution, support);
    largest = std::max(largest, bytes);
  }
  double const jobs = available_memory() / std::max(largest, 1.0);
  return jobs < 1e6 ? std::max(1, static_cast<int>(jobs)) : 1'000'000;
}

int jobs_at_a_time(Study const& study, int asked) {
  int const most = std::max(1, own_cores() / study.threads);
  if (asked > most) {
    fmt::print(stderr,
               "--jobs {}: {} cores hold {} runs of {} threads without disturbing their timings; using {}\n",
               asked, own_cores(), most, study.threads, most);
  }
  return asked == 0 ? most : std::min(asked, most);
}

/// The runs that a part, and a study that holds only some of its runs, leaves of all of them.
void choose_runs(Study& study, StudyOptions const& options, Expansion& expansion) {
  if (study.runs && !study.runs->empty() && study.runs->back() >= expansion.runs.size())
    throw UserError(options.document, "runs", std::to_string(study.runs->back()),
                    fmt::format("numbers below {}, which is how many runs the study has", expansion.runs.size()));
  auto const pick = [](auto& all, std::vector<std::size_t> const& chosen) {
    std::remove_reference_t<decltype(all)> picked;
    for (std::size_t const k : chosen) picked.push_back(all[k]);
    all = std::move(picked);
  };
  if (study.runs) pick(expansion.runs, *study.runs);
  if (!options.part) return;
  if (!study.runs) {
    study.runs.emplace(expansion.runs.size());
    std::iota(study.runs->begin(), study.runs->end(), std::size_t{0});
  }
  std::vector<std::size_t> const chosen = runs_of_part(study, expansion.runs, *options.part);
  pick(expansion.runs, chosen);
  pick(*study.runs, chosen);
}

/// Tells the progress that time passes, as long as it lives.
class Pulse {
 public:
  explicit Pulse(Progress& progress)
      : thread_([this, &progress] {
          std::unique_lock lock(mutex_);
          while (!over_.wait_for(lock, std::chrono::seconds(1), [this] { return is_over_; })) progress.passed();
        }) {}
  ~Pulse() {
    {
      std::scoped_lock const lock(mutex_);
      is_over_ = true;
    }
    over_.notify_one();
    thread_.join();
  }
  Pulse(Pulse const&) = delete;
  Pulse& operator=(Pulse const&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;  // begins when all above is there
};

/// Carries out all runs that the journal does not have, several at a time, in this process.
/// @return all of them, by their place in the journal
std::map<std::size_t, RunRecord> run_here(SharedStudy const& shared, int jobs, Journal* journal, Progress& progress) {
  std::map<std::size_t, RunRecord> finished;
  if (journal) finished = journal->finished();
  std::map<std::size_t, RunRecord> const known = finished;
  std::mutex mutex;
  auto const note = [&](std::size_t place, RunRecord record) {
    std::scoped_lock const lock(mutex);
    finished[place] = std::move(record);
  };
  std::vector<std::size_t> todo;
  for (std::size_t k = 0; k < shared.specs.size(); ++k) {
    if (shared.study.envelope || !known.contains(k)) todo.push_back(k);
  }
  PendingRuns pending(shared.specs, shared.options, journal);
  for (std::size_t const k : todo) pending.add(k);
  pending.sort(todo);
  RunsTold const told{[&](std::size_t place, RunSpec const& spec) -> std::optional<RunRecord> {
                        auto const found = known.find(place);
                        if (found == known.end()) return std::nullopt;
                        journal->require_same(place, spec);
                        return found->second;
                      },
                      [](std::size_t) {},
                      [&](std::size_t place, RunRecord record) {
                        if (journal) journal->append(place, record);
                        note(place, std::move(record));
                      }};
  Pulse const pulse(progress);
  ForkJoin loop;
  tbb::task_arena arena(jobs);
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, todo.size(),
        [&](std::size_t n) {
          ForkJoin::Part const part(loop);
          std::size_t const k = todo[n];
          progress.started(k);
          if (shared.study.envelope) {
            carry_out(shared.study, shared.specs, {{k}, 0, 0.0}, shared.options, told);
            progress.finished(k, shared.specs[k].label);
            return;
          }
          auto done = pending.carry_out(k);
          if (!done.contains(k)) progress.paused(k);
          for (auto& [index, run] : done) {
            progress.finished(index, run.record.label, run.repeat_seconds);
            note(index, std::move(run.record));
          }
        },
        tbb::simple_partitioner{});
  });
  return finished;
}

/// All runs, and what a search found, in the order of the study.
void put_in_order(Study const& study, std::vector<RunSpec> const& specs, std::map<std::size_t, RunRecord> records, Results& results) {
  for (std::size_t k = 0; k < specs.size(); ++k) {
    std::size_t const place = journal_place(study, k);
    if (!study.envelope) {
      results.runs.push_back(std::move(records.at(place)));
      continue;
    }
    results.envelopes.push_back(find_envelope(specs[k], *study.envelope, [&](RunSpec const&, int step) {
      results.runs.push_back(std::move(records.at(place + static_cast<std::size_t>(step))));
      return results.runs.back();
    }));
  }
}

}  // namespace

void run_study(Study study, StudyOptions const& options) {
  Results results;
  results.context = current_context();
  require_writable(options.output);
  bool const to_file = options.output != "-";
  if (options.resume && !to_file)
    throw UserError("--resume: found no results file, expected -o RESULTS.json");

  Rank const rank = rank_of_process();
  if (rank.of > 1 && !to_file)
    throw UserError(fmt::format("study: found {} ranks and no results file, expected -o RESULTS.json, beside which ranks meet", rank.of));
  Expansion expansion = expand(study);
  bool const makes_sense = !expansion.runs.empty();
  Json const whole = to_json([&] {
    Study all = study;
    all.runs.reset();
    return all;
  }());
  choose_runs(study, options, expansion);
  if (rank.of > 1 && !expansion.runs.empty() && static_cast<std::size_t>(rank.of) > expansion.runs.size())
    throw UserError("study", "ranks", std::to_string(rank.of), fmt::format("at most {}, which is how many runs there are", expansion.runs.size()));
  Json const document = to_json(study);
  std::unique_ptr<Journal> journal;
  if (to_file && rank.number == 0) journal = std::make_unique<Journal>(options.output + ".journal", document, options.resume);

  if (journal) remove_unfinished(options.output);
  results.study = whole.dump();
  results.part = study.runs;
  results.skipped = expansion.skipped;
  RunOptions const run_options{.measure = study.measure,
                               .threads = study.threads,
                               .repeat = study.repeat,
                               .time_budget = study.time_budget,
                               .interrupted = options.interrupted};
  std::size_t const units = expansion.runs.size();
  for (Skipped const& s : expansion.skipped) {
    if (!makes_sense || rank.number > 0) break;  // said in one line at the end
    fmt::print(stderr, "skipped: {} on {}: {}\n", s.formulation, s.case_id, s.reason);
  }
  if (!study.envelope && journal) {
    for (std::size_t k = 0; k < units; ++k) journal->require_same(k, expansion.runs[k]);
  }
  SharedStudy const shared{study, expansion.runs, run_options, options.output,
                           rank.of > 1 ? fingerprint(study.plugins) + document.dump() : "", std::max(1, options.jobs)};
  if (rank.number > 0) {
    if (units > 0) work_for_rank_0(shared, rank);
    return;
  }
  int jobs = 1;
  std::map<std::size_t, RunRecord> records;
  if (units > 0) {
    std::vector<RunProgress> runs = expected_work(expansion.runs);
    for (std::size_t k = 0; journal && !study.envelope && k < units; ++k) {
      if (journal->finished().contains(k)) runs[k].state = RunProgress::State::finished_before;
    }
    jobs = rank.of > 1 ? rank.of * shared.workers : std::min(jobs_at_a_time(study, options.jobs), jobs_that_fit(expansion));
    Progress progress(std::move(runs), jobs);
    records = rank.of > 1 ? share_study(shared, rank, *journal, progress) : run_here(shared, jobs, journal.get(), progress);
  }
  put_in_order(study, expansion.runs, std::move(records), results);
  if (!study.envelope && !results.part) {
    results.series = build_series(results.runs, own_cores());
    results.surfaces = build_surfaces(results.runs);
  }
  write_results(options.output, results, options.format);
  if (journal) journal->remove();
  if (!makes_sense) {
    throw UserError(options.document, "formulations", why_nothing_ran(expansion.skipped),
                    "a combination that makes sense");
  }
  say_how_it_went(results.runs);
}

}  // namespace sphverify
