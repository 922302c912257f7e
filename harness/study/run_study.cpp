#include "harness/study/run_study.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <thread>

#include "formulations/basics/fork_join.hpp"
#include "formulations/kernels/kernel.hpp"
#include "harness/measure/series.hpp"
#include "harness/measure/surface.hpp"
#include "harness/study/available_memory.hpp"
#include "harness/study/context.hpp"
#include "harness/study/expand.hpp"
#include "harness/study/journal.hpp"
#include "harness/study/memory.hpp"
#include "harness/study/pending_runs.hpp"
#include "harness/study/progress.hpp"
#include "harness/study/say.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

/// In dx.
double support_of(RunSpec const& run) {
  return kernel(run.discretisation.kernel, 1).support_ratio() * run.smoothing_ratio;
}

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
  int const cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int const most = std::max(1, cores / study.threads);
  if (asked > most) {
    fmt::print(stderr,
               "--jobs {}: {} cores hold {} runs of {} threads without disturbing their timings; using {}\n",
               asked, cores, most, study.threads, most);
  }
  return asked == 0 ? most : std::min(asked, most);
}

/// What the progress of a study starts from.
std::vector<RunProgress> progress_of(Expansion const& expansion) {
  std::vector<RunProgress> all;
  std::optional<AnyProblem> problem;
  for (std::size_t k = 0; k < expansion.runs.size(); ++k) {
    RunSpec const& run = expansion.runs[k];
    RunProgress one;
    if (k > 0) {
      // Runs stand in the order of their cases.
      RunSpec const& before = expansion.runs[k - 1];
      bool const is_same =
          run.scene_case == before.scene_case && run.parameters.all() == before.parameters.all();
      one.kind = all.back().kind + (is_same ? 0 : 1);
      if (!is_same) problem.reset();
    }
    if (!problem) problem = run.scene_case->problem(run.parameters);
    one.work = estimated_work(*problem, run.discretisation.layout, run.resolution, support_of(run));
    all.push_back(one);
  }
  return all;
}

}  // namespace

void run_study(Study const& study, StudyOptions const& options) {
  require_writable(options.output);
  bool const to_file = options.output != "-";
  if (options.resume && !to_file)
    throw UserError("--resume: found no results file, expected -o RESULTS.json");

  Expansion const expansion = expand(study);
  Json const document = to_json(study);
  std::unique_ptr<Journal> journal;
  if (to_file) journal = std::make_unique<Journal>(options.output + ".journal", document, options.resume);

  Results results;
  results.context = current_context();
  results.study = document.dump();
  results.skipped = expansion.skipped;
  RunOptions const run_options{.measure = study.measure,
                               .threads = study.threads,
                               .repeat = study.repeat,
                               .time_budget = study.time_budget,
                               .interrupted = options.interrupted};
  std::size_t const units = expansion.runs.size();
  for (Skipped const& s : expansion.skipped) {
    if (units == 0) break;  // said in one line at the end
    fmt::print(stderr, "skipped: {} on {}: {}\n", s.formulation, s.case_id, s.reason);
  }
  auto const finished_before = [&](std::size_t index) -> RunRecord const* {
    if (!journal) return nullptr;
    auto const known = journal->finished().find(index);
    return known == journal->finished().end() ? nullptr : &known->second;
  };
  // Of an envelope: which value is tried next depends on what became of the one before.
  auto const carry_out = [&](RunSpec const& spec, std::size_t index) {
    if (RunRecord const* const known = finished_before(index)) {
      journal->require_same(index, spec);
      return *known;
    }
    if (options.interrupted && *options.interrupted) throw Interrupted();
    RunRecord record = execute(spec, run_options);
    if (journal) journal->append(index, record);
    return record;
  };
  // What one unit of the study ran: a single run, or those of an envelope.
  std::vector<std::vector<RunRecord>> records(units);
  results.envelopes.resize(study.envelope ? units : 0);
  std::size_t const stride = study.envelope ? static_cast<std::size_t>(most_runs(*study.envelope)) : 1;
  std::vector<std::size_t> todo;
  for (std::size_t k = 0; k < units; ++k) {
    if (journal && !study.envelope) journal->require_same(k, expansion.runs[k]);
    RunRecord const* const known = study.envelope ? nullptr : finished_before(k);
    if (known) {
      records[k] = {*known};
    } else {
      todo.push_back(k);
    }
  }
  int jobs = 1;
  if (units > 0) {
    std::vector<RunProgress> runs = progress_of(expansion);
    for (std::size_t k = 0; k < units; ++k) {
      if (!records[k].empty()) runs[k].state = RunProgress::State::finished_before;
    }
    PendingRuns pending(expansion.runs, run_options, journal.get());
    for (std::size_t const k : todo) pending.add(k);
    pending.sort(todo);
    jobs = std::min(jobs_at_a_time(study, options.jobs), jobs_that_fit(expansion));
    Progress progress(std::move(runs), jobs);
    ForkJoin loop;
    tbb::task_arena arena(jobs);
    arena.execute([&] {
      tbb::parallel_for(
          std::size_t{0}, todo.size(),
          [&](std::size_t n) {
            ForkJoin::Part const part(loop);
            std::size_t const k = todo[n];
            RunSpec const& spec = expansion.runs[k];
            progress.started(k);
            if (study.envelope) {
              results.envelopes[k] = find_envelope(spec, *study.envelope, [&](RunSpec const& one, int step) {
                records[k].push_back(carry_out(one, k * stride + static_cast<std::size_t>(step)));
                return records[k].back();
              });
              progress.finished(k, spec.label);
              return;
            }
            auto finished = pending.carry_out(k);
            if (!finished.contains(k)) progress.paused(k);
            for (auto& [index, run] : finished) {
              records[index] = {std::move(run.record)};
              progress.finished(index, expansion.runs[index].label, run.repeat_seconds);
            }
          },
          tbb::simple_partitioner{});
    });
  }
  for (auto& unit : records) std::move(unit.begin(), unit.end(), std::back_inserter(results.runs));
  if (!study.envelope) {
    results.series = build_series(results.runs, jobs * study.threads);
    results.surfaces = build_surfaces(results.runs);
  }
  write_document(options.output, document_text(to_json(results)));
  if (journal) journal->remove();
  if (units == 0) {
    throw UserError(options.document, "formulations", why_nothing_ran(expansion.skipped),
                    "a combination that makes sense");
  }
  say_how_it_went(results.runs);
}

}  // namespace sphverify
