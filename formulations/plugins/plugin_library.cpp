// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/plugins/plugin_library.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cfenv>
#include <cstring>
#include <filesystem>
#include <list>
#include <utility>

#include "formulations/plugins/crash_guard.hpp"
#include "formulations/plugins/plugin_operator.hpp"
#include "formulations/rate_operator.hpp"

namespace sphverify {

namespace {

template <class Function>
Function* symbol(void* library, char const* name) {
  void* const found = dlsym(library, name);
  if (!found)
    throw BadPlugin(std::string("no function ") + name, "those of sphverify/plugin.h, with C linkage");
  return reinterpret_cast<Function*>(found);
}

template <std::size_t size>
void require_text(char const (&text)[size], char const* what) {
  if (std::memchr(text, '\0', size) == nullptr)
    throw BadPlugin(std::string("a ") + what + " without a zero at its end",
                    "at most " + std::to_string(size - 1) + " letters and a zero");
}

/// Words of lower-case letters and digits, joined by single hyphens.
bool is_name(std::string_view name) {
  bool after_letter = false;
  for (char const c : name) {
    bool const letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (!letter && !(c == '-' && after_letter)) return false;
    after_letter = letter;
  }
  return after_letter;
}

constexpr std::array of_particles{std::pair{SPHVERIFY_DENSITY, Field::density},
                                  std::pair{SPHVERIFY_VELOCITY, Field::velocity},
                                  std::pair{SPHVERIFY_PRESSURE, Field::pressure},
                                  std::pair{SPHVERIFY_TEMPERATURE, Field::temperature},
                                  std::pair{SPHVERIFY_CONDUCTIVITY, Field::conductivity},
                                  std::pair{SPHVERIFY_SOUND_SPEED, Field::sound_speed}};
constexpr std::array at_walls{std::pair{SPHVERIFY_VELOCITY, BoundaryValue::velocity},
                              std::pair{SPHVERIFY_PRESSURE, BoundaryValue::pressure},
                              std::pair{SPHVERIFY_TEMPERATURE, BoundaryValue::temperature},
                              std::pair{SPHVERIFY_CONDUCTIVITY, BoundaryValue::conductivity},
                              std::pair{SPHVERIFY_FLUX, BoundaryValue::flux}};

/// The set that bits stand for.
template <class Pairs>
auto set_of(int bits, Pairs const& pairs, char const* what) {
  FlagSet<typename Pairs::value_type::second_type> set;
  int known = 0;
  for (auto const& [bit, value] : pairs) {
    known |= bit;
    if (bits & bit) set.insert(value);
  }
  if ((bits & ~known) != 0)
    throw BadPlugin(std::string(what) + " = " + std::to_string(bits), "a sum of the bits that sphverify/plugin.h names");
  return set;
}

constexpr std::array invariants{std::pair{SPHVERIFY_CONSERVES_MOMENTUM, Invariant::momentum},
                                std::pair{SPHVERIFY_CONSERVES_ENERGY, Invariant::energy}};
constexpr std::array known_rates{Rate::acceleration, Rate::internal_work, Rate::total_work, Rate::conduction_heating};

}  // namespace

PluginLibrary::PluginLibrary(std::string path) : path_(std::move(path)) {
  // A name without a folder would be looked for among the system's libraries.
  std::string const file = path_.find('/') == std::string::npos ? "./" + path_ : path_;
  if (!std::filesystem::exists(file)) throw BadPlugin("no such file", "a shared library");
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw BadPlugin(std::string("what cannot be loaded (") + dlerror() + ")", "a shared library");
  auto* const abi = symbol<int()>(library, "sphverify_plugin_abi");
  describe_ = symbol<void(sphverify_description*)>(library, "sphverify_plugin_describe");
  rates_ = symbol<int(sphverify_state const*, sphverify_rates*)>(library, "sphverify_plugin_rates");
  int version = 0;
  {
    CrashGuard const guard("a plug-in that says its version", path_.c_str());
    version = abi();
  }
  if (version != SPHVERIFY_PLUGIN_ABI) {
    throw BadPlugin("a plug-in of version " + std::to_string(version) + " of the interface",
                    "version " + std::to_string(SPHVERIFY_PLUGIN_ABI) + ": compile it anew with this sphverify/plugin.h");
  }
  describe();
}

void PluginLibrary::describe() {
  {
    CrashGuard const guard("a plug-in that describes itself", path_.c_str());
    describe_(&description_);
  }
  sphverify_description const& d = description_;
  require_text(d.name, "name");
  require_text(d.title, "title");
  require_text(d.source, "source");
  require_text(d.equation, "equation");
  require_text(d.work_partner, "work_partner");
  if (!is_name(d.name))
    throw BadPlugin("the name '" + std::string(d.name) + "'", "words of a-z and 0-9, joined by hyphens");
  if (d.rate < 0 || d.rate >= static_cast<int>(known_rates.size()))
    throw BadPlugin("rate = " + std::to_string(d.rate), "one of enum sphverify_rate");
  if (d.passes < 0 || d.passes > 4) throw BadPlugin("passes = " + std::to_string(d.passes), "1 to 4");
  if (d.work_partner[0] != '\0' && known_rates[static_cast<std::size_t>(d.rate)] != Rate::acceleration)
    throw BadPlugin("a work_partner of what is no acceleration", "none");
  id_ = std::string("plugin/") + d.name;
  info_.id = id_;
  info_.title = d.title[0] != '\0' ? std::string_view(d.title) : "A plug-in that says nothing of itself";
  info_.source = d.source;
  info_.equation = d.equation;
  info_.remarks = path_;
  info_.rate = known_rates[static_cast<std::size_t>(d.rate)];
  asked_ = set_of(d.reads, of_particles, "reads");
  info_.kernel = {KernelWeight::gradient};
  info_.boundary = set_of(d.reads_at_walls & ~(SPHVERIFY_FLUX | SPHVERIFY_DENSITY), at_walls, "reads_at_walls");
  if (d.reads_at_walls & SPHVERIFY_FLUX) info_.boundary_if_prescribed.insert(BoundaryValue::flux);
  info_.reads = asked_ | closure_fields(info_.boundary | info_.boundary_if_prescribed);
  InvariantSet const conserves = set_of(d.conserves, invariants, "conserves");
  bool const is_momentum = info_.rate == Rate::acceleration;
  info_.claims.energy_with_partner = is_momentum && conserves.contains(Invariant::energy);
  if (conserves.contains(is_momentum ? Invariant::momentum : Invariant::energy))
    info_.conserves.insert(is_momentum ? Invariant::momentum : Invariant::energy);
  info_.claims.galilean_invariant = info_.rate != Rate::total_work;
  // What divides by sums of its own may be exact, and has no limit where a single neighbour is left.
  info_.claims.linear_on_lattice = info_.claims.continuous_at_support = d.passes <= 1;
  info_.work_partner = d.work_partner;
  info_.supports_seen = std::max(1, static_cast<int>(d.passes));
}

void PluginLibrary::rates(sphverify_state const& state, sphverify_rates& rates) {
  std::unique_lock lock(one_at_a_time_, std::defer_lock);
  if (!description_.thread_safe) lock.lock();
  int status = 0;
  {
    CrashGuard const guard(id_.c_str(), path_.c_str());
    // A rounding mode that it leaves behind would be everybody's.
    std::fenv_t ours;
    std::fegetenv(&ours);
    status = rates_(&state, &rates);
    std::fesetenv(&ours);
  }
  if (status != 0) throw std::invalid_argument(id_ + " (" + path_ + ") says that it failed: status " + std::to_string(status));
}

std::string const& load_plugin(std::string const& path) {
  static std::list<PluginLibrary> loaded;
  std::string const canonical = std::filesystem::weakly_canonical(path).string();
  static std::list<std::pair<std::string, std::string>> known;  // canonical path, identifier
  for (auto const& [file, id] : known) {
    if (file == canonical) return id;
  }
  PluginLibrary& library = loaded.emplace_back(path);
  std::string const id(library.info().id);
  if (find_scheme(id)) throw BadPlugin("a second plug-in that is called " + id, "a name of its own for each");
  add_scheme({.info = &library.info(),
              .in_1d = [&library] { return make_plugin_operator<1>(library); },
              .in_2d = [&library] { return make_plugin_operator<2>(library); },
              .in_3d = [&library] { return make_plugin_operator<3>(library); }});
  return known.emplace_back(canonical, id).second;
}

}  // namespace sphverify
