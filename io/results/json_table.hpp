// Structs to JSON and back by the keys that are declared once for them: void keys(Table&, Struct&).
#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>

#include "io/config/key_unit.hpp"
#include "io/config/words.hpp"

namespace havers::io {

class JsonWriter;

/// A struct that has keys.
template <class T>
concept Keyed = requires(JsonWriter& table, T& value) {
  keys(table, value);
};

/// A map from texts: a JSON object whose keys are those of the map.
template <class T>
concept TextMap = requires {
  typename T::mapped_type;
};

/// Any other container, of fixed length or not: a JSON array.
template <class T>
concept List = requires(T& value) {
  value.begin();
}
&&!TextMap<T> && !std::is_same_v<T, std::string>;

/// JSON of a number given in SI units; null where it is not finite, or none.
inline nlohmann::json json_of(double value, KeyUnit unit = {}) {
  return std::isfinite(value) ? nlohmann::json(from_si(value, unit)) : nlohmann::json();
}
inline nlohmann::json json_of(const std::optional<double>& value) {
  return value ? json_of(*value) : nlohmann::json();
}

/// JSON of anything else, its numbers given in SI units; the items of a container share the unit.
/// Not const, as keys() needs a value that it could also read into.
template <class T>
nlohmann::json written(T& value, KeyUnit unit = {});

/// The same of a copy: keys are declared once, for writing and for reading.
template <class T>
nlohmann::json json_of(T value) {
  return written(value);
}

/// Writes keys into a JSON object, beside those that it has already.
class JsonWriter {
 public:
  explicit JsonWriter(nlohmann::json& object) : object_(&object) {}

  template <class T>
  void key(const char* name, T& value, KeyUnit unit = {}) {
    (*object_)[name] = written(value, unit);
  }
  template <class T>
  void key(const char* name, std::optional<T>& value, KeyUnit unit = {}) {
    if (value) key(name, *value, unit);
  }
  /// An inner object that is no struct of its own.
  template <class Inner>
  void group(const char* name, Inner inner) {
    JsonWriter table((*object_)[name] = nlohmann::json::object());
    inner(table);
  }

 private:
  nlohmann::json* object_;
};

template <class T>
nlohmann::json written(T& value, KeyUnit unit) {
  nlohmann::json json;
  if constexpr (std::is_same_v<T, double>) {
    json = json_of(value, unit);
  } else if constexpr (Worded<T>) {
    json = word(value);
  } else if constexpr (TextMap<T>) {
    json = nlohmann::json::object();
    for (auto& [name, item] : value) json[name] = written(item, unit);
  } else if constexpr (List<T>) {
    json = nlohmann::json::array();
    for (auto& item : value) json.push_back(written(item, unit));
  } else if constexpr (Keyed<T>) {
    json = nlohmann::json::object();
    JsonWriter table(json);
    keys(table, value);
  } else {
    json = value;
  }
  return json;
}

/// Reads keys from a JSON object. An absent key leaves its value as it is, and so does an unknown
/// word; null makes a number NaN. A value of another type ends in an exception of nlohmann::json.
class JsonReader {
 public:
  explicit JsonReader(const nlohmann::json& object) : object_(&object) {}

  template <class T>
  void key(const char* name, T& value, KeyUnit unit = {}) {
    if (object_->contains(name)) read(object_->at(name), value, unit);
  }
  /// A key that is there always gives a value; for a number null gives NaN.
  template <class T>
  void key(const char* name, std::optional<T>& value, KeyUnit unit = {}) {
    if (object_->contains(name)) read(object_->at(name), value.emplace(), unit);
  }
  /// Reads what JsonWriter's `group` wrote; where it is absent, all its values stay.
  template <class Inner>
  void group(const char* name, Inner inner) {
    if (!object_->contains(name)) return;
    JsonReader table(object_->at(name));
    inner(table);
  }

 private:
  /// The inverse of `written`, case by case.
  template <class T>
  static void read(const nlohmann::json& json, T& value, KeyUnit unit) {
    if constexpr (std::is_same_v<T, double>) {
      value = json.is_null() ? std::numeric_limits<double>::quiet_NaN()
                             : to_si(json.get<double>(), unit);
    } else if constexpr (Worded<T>) {
      for (std::size_t i = 0; i < words<T>.size(); ++i)
        if (words<T>.at(i) == json.get<std::string>()) value = static_cast<T>(i);
    } else if constexpr (TextMap<T>) {
      for (const auto& [name, item] : json.items()) read(item, value[name], unit);
    } else if constexpr (List<T>) {
      // An array of fixed length takes the first items; too few items throw.
      if constexpr (requires { value.resize(0); }) value.resize(json.size());
      for (std::size_t i = 0; i < value.size(); ++i) read(json.at(i), value.at(i), unit);
    } else if constexpr (Keyed<T>) {
      JsonReader table(json);
      keys(table, value);
    } else {
      json.get_to(value);
    }
  }

  const nlohmann::json* object_;
};

}  // namespace havers::io
