#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.hpp"

namespace sphverify {

/// Which cases, with their parameters, have runs that were timed on several machines. Their times say more of the
/// machines than of the formulations: nothing divides one by the other.
class TimedApart {
 public:
  explicit TimedApart(std::vector<RunRecord> const& runs) {
    for (RunRecord const& run : runs) {
      if (run.cost) machines_[{run.case_id, run.parameters}].insert(run.cost->machine);
    }
  }

  bool contains(std::string const& case_id, std::map<std::string, ParameterValue> const& parameters) const {
    auto const found = machines_.find({case_id, parameters});
    return found != machines_.end() && found->second.size() > 1;
  }

 private:
  std::map<std::pair<std::string, std::map<std::string, ParameterValue>>, std::set<std::string>> machines_;
};

}  // namespace sphverify
