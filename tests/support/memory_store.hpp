// A store of simulations that lives as long as its test.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "calib/fit/evaluation_store.hpp"

namespace havers::test {

class MemoryStore final : public calib::EvaluationStore {
 public:
  std::optional<calib::Response> find(const std::string& key) override {
    const std::scoped_lock lock(mutex_);
    const auto found = kept_.find(key);
    return found == kept_.end() ? std::nullopt : std::optional(found->second);
  }
  void save(const std::string& key, const calib::Response& response) override {
    const std::scoped_lock lock(mutex_);
    kept_[key] = response;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, calib::Response> kept_;
};

}  // namespace havers::test
