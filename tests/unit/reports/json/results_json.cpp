// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/json/results_json.hpp"

#include <sys/stat.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "tests/support/documents.hpp"
#include "tests/support/full_results.hpp"

BOOST_AUTO_TEST_SUITE(reports_json_results_json)

using namespace sphverify;
using namespace sphverify::tests;

double constexpr nan = std::numeric_limits<double>::quiet_NaN();
double constexpr infinity = std::numeric_limits<double>::infinity();

BOOST_AUTO_TEST_CASE(numbers_in_lists_that_are_not_finite_are_null_and_read_again) {
  RunRecord r = full_run();
  double const nothing = std::numeric_limits<double>::quiet_NaN();
  r.profile->exact["velocity"][1][0] = nothing;
  r.profile->weight[0] = std::numeric_limits<double>::infinity();
  r.history->energy[1] = nothing;
  r.spectrum[0][1] = nothing;
  Json const json = to_json(r);
  BOOST_TEST(json.at("profile").at("exact").at("velocity")[1][0].is_null());
  BOOST_TEST(json.at("profile").at("weight")[0].is_null());
  RunRecord const again = read_run(Node(json, "f"));
  BOOST_TEST(std::isnan(again.profile->exact.at("velocity")[1][0]));
  BOOST_TEST(std::isnan(again.profile->weight[0]));
  BOOST_TEST(std::isnan(again.history->energy[1]));
  BOOST_TEST(to_json(again).dump() == json.dump());
}

BOOST_AUTO_TEST_CASE(a_run_with_everything_reads_back_as_the_same_document) {
  Json const document = to_json(full_run());
  BOOST_TEST(to_json(read_run(Node(document, "f"))).dump(1) == document.dump(1));
  Json const empty = to_json(RunRecord{});
  BOOST_TEST(to_json(read_run(Node(empty, "f"))).dump(1) == empty.dump(1));
}

BOOST_AUTO_TEST_CASE(every_layout_reads_back_with_what_belongs_to_it) {
  for (LayoutChoice const& layout : {LayoutChoice{"lattice"},
                                     {"jittered", 0.15, 7},
                                     {"clumped", 0.25},
                                     {"touching", 0.03},
                                     {"equal-mass"},
                                     {"hexagonal"},
                                     {"close-packed"},
                                     {"glass", 0.0, 9},
                                     {"random", 0.0, 9}}) {
    RunRecord run = full_run();
    run.discretisation.layout = layout;
    BOOST_TEST((read_run(Node(to_json(run), "f")).discretisation.layout == layout), layout.id);
  }
}

BOOST_AUTO_TEST_CASE(what_a_run_holds_survives_the_document) {
  RunRecord const run = full_run();
  Json const document = to_json(run);
  RunRecord const read = read_run(Node(document, "f"));
  BOOST_TEST((read.parameters == run.parameters));
  BOOST_TEST((read.formulation == run.formulation));
  BOOST_TEST((read.discretisation == run.discretisation));
  BOOST_TEST(read.label == run.label);
  BOOST_TEST(read.particles == run.particles);
  BOOST_TEST(read.scene.passes.at("flux") == 20u);
  BOOST_TEST(read.errors.at("temperature").at("wall").error.linf == 0.6);
  BOOST_TEST(read.errors.at("flux").at("all").scale.l1 == 1.7);
  BOOST_TEST(read.errors.at("temperature").at("wall").initial->l2 == 0.55);
  BOOST_TEST(*read.errors.at("temperature").at("wall").mean == -0.33);
  BOOST_TEST(!read.errors.at("flux").at("all").initial.has_value());
  BOOST_TEST(!read.conservation.at("mass").wall_budget_defect.has_value());
  BOOST_TEST(*read.conservation.at("energy").wall_budget_defect == -0.07);
  BOOST_TEST(!read.conservation.contains("momentum"));
  BOOST_TEST(read.cost->pair_interactions == 9007199254740993ull);
  BOOST_TEST(*read.cost->median.median == 4.3);
  BOOST_TEST(*read.cost->median.low == 4.15);
  BOOST_TEST(*read.cost->median.high == 4.6);
  BOOST_TEST(*read.cost->busy == 0.97);
  BOOST_TEST(read.cost->batch == 64);
  BOOST_TEST(read.cost->warm_up);
  BOOST_TEST(read.cost->occasion == "0123abcd");
  BOOST_TEST((read.cost->round_seconds == std::vector<double>{4.1, 4.3, 4.6}));
  BOOST_TEST(*read.stability->growing_modes == 6u);
  BOOST_TEST(!read.stability->largest_stable_step.has_value());
  BOOST_TEST(*read.stability->largest_imaginary == 5.3);
  BOOST_TEST(*read.stability->unseen_modes == 7u);
  BOOST_TEST(read.stability->method == "dense");
  BOOST_TEST(read.stability->worst_mode->growth == 5.4);
  BOOST_TEST(read.stability->worst_mode->frequency == 5.5);
  BOOST_TEST(*read.stability->worst_mode->wavelength == 5.6);
  BOOST_TEST(!read.stability->worst_mode->wall_share.has_value());
  BOOST_TEST(read.stability->worst_mode->centre == (std::vector<double>{0.1, 0.2}));
  BOOST_TEST(*read.stability->stable_steps.at("heun").theory == 0.3);
  BOOST_TEST(*read.stability->stable_steps.at("heun").measured == 0.31);
  BOOST_TEST(read.stability->stable_steps.at("heun").remark == "as far as tried");
  BOOST_TEST(*read.stability->modes.at(0).wall_share == 0.4);
  BOOST_TEST(read.second_law->overshoot.size == 0.11);
  BOOST_TEST(read.second_law->overshoot.time == 0.12);
  BOOST_TEST(read.second_law->undershoot.position.empty());
  BOOST_TEST(read.second_law->cold_to_hot.position.at(0) == 0.16);
  BOOST_TEST(*read.second_law->smallest_entropy_production == -0.17);
  BOOST_TEST(read.second_law->remark == "entropy fell");
  BOOST_TEST(*read.integration->time_error_share == 0.003);
  BOOST_TEST(read.smallest_face_weight->value() == -0.3);
  BOOST_TEST(read.profile->exact.at("velocity")[1][0] == 3.5);
  BOOST_TEST(read.history->exchanged[1] == 5.0);
  BOOST_TEST(read.spectrum[0][1] == 0.5);
}

BOOST_AUTO_TEST_CASE(results_written_to_a_file_read_back_as_the_same_document) {
  TemporaryFolder const folder;
  std::string const path = folder.file("results.json");
  std::string const text = document_text(to_json(full_results()));
  write_document(path, text);
  BOOST_TEST(document_text(to_json(read_results(path))) == text);
}

BOOST_AUTO_TEST_CASE(a_resolution_that_no_run_has_is_refused_where_it_stands) {
  Json run = to_json(full_run());
  run["resolution"] = 4294967336;  // 40 in the lower 32 bits
  BOOST_CHECK_EXCEPTION(read_run(Node(run, "f", "runs[0]")), UserError, [](UserError const& error) {
    return std::string(error.what()).find("runs[0].resolution: found 4294967336") != std::string::npos;
  });
}

BOOST_AUTO_TEST_CASE(what_an_order_says_survives_the_document) {
  TemporaryFolder const folder;
  std::string const path = folder.file("results.json");
  write_document(path, document_text(to_json(full_results())));
  OrderEntry const read = read_results(path).series[0].orders[0];
  BOOST_TEST(read.observed.model == "floor");
  BOOST_TEST(read.observed.law->floor == 0.01);
  BOOST_TEST(read.observed.law->coefficient == 0.09);
  BOOST_TEST(read.observed.law->exponent == 1.5);
  BOOST_TEST(read.observed.law->next_coefficient == 0.2);
  BOOST_TEST(read.observed.law->next_exponent == 2.0);
  BOOST_TEST(read.observed.floor->lower == 0.008);
  BOOST_TEST(read.observed.floor->upper == 0.012);
  BOOST_TEST(*read.observed.targets.at(0).resolution == 77.0);
  BOOST_TEST(*read.observed.targets.at(0).relative == 0.05);
  BOOST_TEST(!read.observed.targets.at(1).resolution.has_value());
  BOOST_TEST(read.observed.targets.at(1).remark == "never");
  BOOST_TEST(*read.levels.at(0).mean == -0.06);
}

BOOST_AUTO_TEST_CASE(times_of_levels_and_to_an_error_survive_the_document) {
  TemporaryFolder const folder;
  std::string const path = folder.file("results.json");
  Json document = to_json(full_results());
  write_document(path, document_text(document));
  Series const read = read_results(path).series[0];
  BOOST_TEST(*read.orders[0].levels[0].median.low == 2.55);
  BOOST_TEST(!read.orders[0].levels[1].median.median.has_value());
  BOOST_TEST(*read.time_to_error[0].median.median == 3.6);
  BOOST_TEST(*read.time_to_error[0].median.high == 3.7);
  // A baseline that was stored before medians were measured stays a baseline.
  for (char const* key : {"median_seconds", "low_seconds", "high_seconds"}) {
    document["runs"][0]["cost"].erase(key);
    document["series"][0]["orders"][0]["levels"][0].erase(key);
    document["series"][0]["time_to_error"][0].erase(key);
  }
  for (char const* key : {"busy", "batch", "warm_up", "occasion", "round_seconds"})
    document["runs"][0]["cost"].erase(key);
  write_document(path, document_text(document));
  BOOST_TEST(!read_results(path).runs[0].cost->median.median.has_value());
}

BOOST_AUTO_TEST_CASE(a_document_holds_the_keys_of_the_contract) {
  Json const run = to_json(full_results()).at("runs")[0];
  for (char const* key : {"case",
                          "parameters",
                          "formulation",
                          "work",
                          "conduction",
                          "label",
                          "walls",
                          "discretisation",
                          "smoothing_exponent",
                          "resolution",
                          "particles",
                          "spacing",
                          "smoothing_length",
                          "status",
                          "reason",
                          "scene",
                          "errors",
                          "conservation",
                          "wall_flux",
                          "cost",
                          "stability"}) {
    BOOST_TEST(run.contains(key), key);
  }
  BOOST_TEST(run.at("walls") == "off");
  BOOST_TEST(run.at("parameters").at("dimension").dump() == "2");
  BOOST_TEST(run.at("conservation").at("momentum").is_null());
  Json const document = to_json(full_results());
  BOOST_TEST(document.at("schema") == "sphverify-results/1");
  for (char const* key : {"context", "study", "runs", "series", "skipped"})
    BOOST_TEST(document.contains(key));
  BOOST_TEST(document.at("series")[0].at("orders")[1].at("interval").is_null());
  BOOST_TEST(document.at("series")[0].at("orders")[1].at("order").is_null());
}

BOOST_AUTO_TEST_CASE(numbers_that_do_not_exist_are_null) {
  RunRecord run = full_run();
  run.errors["temperature"]["all"].error = {nan, infinity, -infinity};
  run.conservation["energy"].drift = nan;
  run.wall_flux[0].exact = nan;
  run.cost->cpu_seconds = nan;
  run.stability->spectral_abscissa = infinity;
  run.history->energy[0] = nan;
  Json const document = to_json(run);
  for (char const* norm : {"l1", "l2", "linf"})
    BOOST_TEST(document.at("errors").at("temperature").at("all").at(norm).is_null());
  BOOST_TEST(document.at("conservation").at("energy").at("drift").is_null());
  BOOST_TEST(document.at("wall_flux")[0].at("exact").is_null());
  BOOST_TEST(document.at("cost").at("cpu_seconds").is_null());
  BOOST_TEST(document.at("stability").at("spectral_abscissa").is_null());
  BOOST_TEST(document.at("history").at("energy")[0].is_null());
}

// compare and --resume must be able to read whatever study wrote.
BOOST_AUTO_TEST_CASE(a_document_with_nulls_for_numbers_can_be_read) {
  RunRecord run = full_run();
  run.errors["temperature"]["all"].error.linf = nan;
  Json const error = to_json(run);
  BOOST_CHECK_NO_THROW(read_run(Node(error, "f")));
  run = full_run();
  run.conservation["energy"].drift = nan;
  Json const drift = to_json(run);
  BOOST_CHECK_NO_THROW(read_run(Node(drift, "f")));
  run = full_run();
  run.wall_flux[0].exact = infinity;
  Json const flux = to_json(run);
  BOOST_CHECK_NO_THROW(read_run(Node(flux, "f")));
}

BOOST_AUTO_TEST_CASE(a_damaged_results_document_is_refused_naming_the_key) {
  TemporaryFolder const folder;
  std::string const path = folder.file("results.json");
  auto const said = [&](Json const& document) {
    write_text(path, document.dump());
    return complaint([&] { read_results(path); });
  };
  Json document = to_json(full_results());
  document["runs"][0]["resolution"] = "many";
  BOOST_TEST(said(document).find("runs[0].resolution: found 'many'") != std::string::npos);
  document = to_json(full_results());
  document["series"][0]["runs"] = {0, 7};
  BOOST_TEST(said(document).find("series[0].runs") != std::string::npos);
  document = to_json(full_results());
  document.erase("skipped");
  BOOST_TEST(said(document).find("skipped: found nothing") != std::string::npos);
  document["schema"] = "sphverify-study/1";
  BOOST_TEST(said(document).find("expected sphverify-results/1") != std::string::npos);
  document = to_json(full_results());
  document["series"][0]["orders"][0]["interval"] = {1.0};
  BOOST_TEST(!said(document).empty());  // and no other exception
}

BOOST_AUTO_TEST_CASE(text_of_a_document_parses_back_to_the_same) {
  Json const document = to_json(full_results());
  std::string const text = document_text(document);
  BOOST_TEST(Json::parse(text).dump() == document.dump());
  BOOST_TEST(text.back() == '\n');
  for (Json const& small : {Json(nullptr), Json(0.1), Json::array(), Json::object(), Json("ä\"\\\n"),
                            Json{{"key \"q\"", std::vector<double>(100, 1.0 / 3.0)}}}) {
    BOOST_TEST(Json::parse(document_text(small)).dump() == small.dump());
  }
}

BOOST_AUTO_TEST_CASE(writing_replaces_a_file_whole_and_leaves_nothing_beside_it) {
  TemporaryFolder const folder;
  std::string const path = folder.file("a.json");
  write_document(path, std::string(100'000, 'x'));
  write_document(path, "short");
  BOOST_TEST(text_of(path) == "short");
  std::size_t files = 0;
  for ([[maybe_unused]] auto const& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  BOOST_TEST(files == 1u);
}

BOOST_AUTO_TEST_CASE(a_file_is_the_old_one_or_the_new_one_and_never_half_of_each) {
  TemporaryFolder const folder;
  std::string const path = folder.file("a.json");
  write_text(path, "old");
  // Another name of the old file: written in place it would change too.
  std::filesystem::create_hard_link(path, folder.file("old.json"));
  write_document(path, "new");
  BOOST_TEST(text_of(path) == "new");
  BOOST_TEST(text_of(folder.file("old.json")) == "old");
}

BOOST_AUTO_TEST_CASE(a_place_that_cannot_be_written_is_the_user_s_error_and_what_is_there_stays) {
  TemporaryFolder const folder;
  std::string const said = complaint([&] { write_document("/no/such/folder/a.json", "text"); });
  BOOST_TEST(said.find("/no/such/folder/a.json") != std::string::npos, said);
  BOOST_CHECK_THROW(require_writable("/no/such/folder/a.json"), UserError);
  // A folder in the way: nothing may be renamed over it.
  std::string const in_the_way = folder.file("folder");
  std::filesystem::create_directory(in_the_way);
  write_text(in_the_way + "/inside", "kept");
  BOOST_CHECK_THROW(write_document(in_the_way, "text"), UserError);
  BOOST_CHECK_THROW(require_writable(in_the_way), UserError);
  BOOST_TEST(text_of(in_the_way + "/inside") == "kept");
}

BOOST_AUTO_TEST_CASE(asking_whether_a_place_can_be_written_changes_nothing) {
  TemporaryFolder const folder;
  std::string const path = folder.file("a.json");
  require_writable(path);
  BOOST_TEST(!std::filesystem::exists(path));
  write_text(path, "kept");
  require_writable(path);
  BOOST_TEST(text_of(path) == "kept");
  require_writable("-");
}

BOOST_AUTO_TEST_SUITE_END()
