// Words are looked for inside names, since names are often compound: "Tensile strain (Strain 1)",
// "Standardkraft". Words that are common inside others must stand alone.
#include "io/machine/vocabulary.hpp"

#include <algorithm>
#include <array>

#include "io/machine/words.hpp"

namespace havers::io {
namespace {

struct QuantityWord {
  std::string_view word;
  Quantity quantity;
  Match match = Match::anywhere;
};

// The first word found decides, so what contains another word comes first: "Zugspannung" and
// "strain gauge load" before "load", 应力 (stress) before 力 (force). Languages: en fr de es it pl
// pt zh.
using enum Quantity;
constexpr std::array quantity_words{
    QuantityWord{"rate", other, Match::alone},
    QuantityWord{"speed", other},
    QuantityWord{"cycle", other},
    QuantityWord{"temperat", other},
    QuantityWord{"températ", other},
    QuantityWord{"strain", strain},
    QuantityWord{"dms", strain, Match::alone},
    QuantityWord{"sg", strain, Match::alone},
    QuantityWord{"jauge", strain},  // de contrainte
    QuantityWord{"tensometr", strain},
    QuantityWord{"epsilon", strain},
    QuantityWord{"eps", strain, Match::alone},
    QuantityWord{"ε", strain, Match::alone},
    QuantityWord{"extensomét", strain},
    QuantityWord{"extensomet", strain},  // its elongation, where it is in mm
    QuantityWord{"extensomèt", strain},
    QuantityWord{"extensómet", strain},
    QuantityWord{"estensimet", strain},
    QuantityWord{"déform", strain},
    QuantityWord{"dehnung", strain},
    QuantityWord{"deformación", strain},
    QuantityWord{"deformazione", strain},
    QuantityWord{"deformação", strain},
    QuantityWord{"odkształcenie", strain},
    QuantityWord{"应变", strain},
    QuantityWord{"stress", stress},
    QuantityWord{"contrainte", stress},
    QuantityWord{"spannung", stress},
    QuantityWord{"esfuerzo", stress},
    QuantityWord{"tensión", stress, Match::alone},
    QuantityWord{"sforzo", stress, Match::alone},
    QuantityWord{"tensione", stress, Match::alone},
    QuantityWord{"naprężenie", stress},
    QuantityWord{"tensão", stress, Match::alone},
    QuantityWord{"应力", stress},
    QuantityWord{"load", force},
    QuantityWord{"force", force},
    QuantityWord{"charge", force, Match::alone},
    QuantityWord{"kraft", force},
    QuantityWord{"last", force, Match::alone},
    QuantityWord{"fuerza", force},
    QuantityWord{"carga", force},
    QuantityWord{"forza", force},
    QuantityWord{"carico", force},
    QuantityWord{"siła", force, Match::alone},
    QuantityWord{"obciążenie", force},
    QuantityWord{"força", force},
    QuantityWord{"载荷", force},
    QuantityWord{"力", force},
    QuantityWord{"time", time, Match::alone},
    QuantityWord{"temps", time},
    QuantityWord{"zeit", time},
    QuantityWord{"tiempo", time},
    QuantityWord{"tempo", time, Match::alone},
    QuantityWord{"czas", time},
    QuantityWord{"时间", time},
    QuantityWord{"extension", extension},
    QuantityWord{"elongation", extension},
    QuantityWord{"displacement", extension},
    QuantityWord{"crosshead", extension},
    QuantityWord{"stroke", extension},
    QuantityWord{"travel", extension},
    QuantityWord{"position", extension},
    QuantityWord{"déplacement", extension},
    QuantityWord{"allongement", extension},
    QuantityWord{"traverse", extension},
    QuantityWord{"course", extension},
    QuantityWord{"verschiebung", extension},
    QuantityWord{"verlängerung", extension},
    QuantityWord{"weg", extension},
    QuantityWord{"desplazamiento", extension},
    QuantityWord{"extensión", extension},
    QuantityWord{"alargamiento", extension},
    QuantityWord{"spostamento", extension},
    QuantityWord{"allungamento", extension},
    QuantityWord{"estensione", extension},
    QuantityWord{"przemieszczenie", extension},
    QuantityWord{"wydłużenie", extension},
    QuantityWord{"deslocamento", extension},
    QuantityWord{"extensão", extension},
    QuantityWord{"位移", extension},
};

// Columns that are no reading along the load: across the load, commands, peaks so far.
constexpr std::array<std::string_view, 18> no_reading_words{
    "transvers", "trasvers", "querdehn", "lateral", "poprzeczn", "横向",
    "command",   "comando",  "consign",  "soll",    "setpoint",  "set point",
    "set-point", "target",   "zadan",    "指令",    "maximum",   "maximal"};
constexpr std::array<std::string_view, 4> no_reading_alone{"peak", "demand", "quer", "trans"};
// Sensors of their own: strain gauges, extensometers, load cells.
constexpr std::array<std::string_view, 12> sensor_words{
    "gauge",    "gage",      "extenso",   "jauge",  "galga",     "feindehn",
    "estensim", "ekstensom", "tensometr", "引伸计", "load cell", "dehnungsmess"};
constexpr std::array<std::string_view, 2> sensor_alone{"dms", "sg"};
// Of strain and stress that are not engineering ones.
constexpr std::array<std::string_view, 8> true_words{
    "true", "wahre", "vraie", "logarithm", "hencky", "verdader", "rzeczywist", "真"};

constexpr std::array<std::string_view, 6> compression_words{"compress", "compresi", "druck",
                                                            "kompresj", "ścisk",    "压缩"};
// Of a load cell for both, as "tension/compression", neither is meant.
constexpr std::array<std::string_view, 8> tension_words{"tensi", "tracti", "tracci",  "traz",
                                                        "traç",  "zug",    "rozciąg", "拉"};

// One number a test, in any of the languages.
constexpr std::array<std::string_view, 26> result_words{
    "maximum",      "maximal",    "max.",        "modulus",  "module",      "modul",      "módulo",
    "modulo",       "moduł",      "strength",    "at break", "at yield",    "at peak",    "rupture",
    "à la rup",     "festigkeit", "bruch",       "rotura",   "resistencia", "resistenza", "rottura",
    "wytrzymałość", "zerwani",    "resistência", "模量",     "强度"};

}  // namespace

Quantity quantity_of_name(std::string_view name) {
  const std::string text = lower(name);
  for (const QuantityWord& known : quantity_words)
    if (contains(text, known.word, known.match)) return known.quantity;
  return other;
}

bool is_no_reading(std::string_view name) {
  const std::string text = lower(name);
  return contains_any(text, no_reading_words) || contains_any(text, no_reading_alone, Match::alone);
}

bool is_of_sensor(std::string_view name) {
  const std::string text = lower(name);
  return contains_any(text, sensor_words) || contains_any(text, sensor_alone, Match::alone);
}

bool are_alike(std::string_view one, std::string_view other) {
  const std::string a = lower(one), b = lower(other);
  if (a == b) return false;
  const auto both = [&](std::string_view word, Match match) {
    return contains(a, word, match) && contains(b, word, match);
  };
  const auto undigited = [](std::string text) {
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text;
  };
  return undigited(a) == undigited(b) ||
         std::ranges::any_of(sensor_words, [&](auto w) { return both(w, Match::anywhere); }) ||
         std::ranges::any_of(sensor_alone, [&](auto w) { return both(w, Match::alone); });
}

bool counts_compression(std::string_view name) {
  const std::string text = lower(name);
  return contains_any(text, compression_words) && !contains_any(text, tension_words);
}

// A strain whose name also speaks of travel, unless it is an elongation in a unit of length, which
// is a gauge's; or a travel in a unit of strain.
bool is_crosshead_strain(std::string_view name, std::optional<Dimension> unit) {
  const std::string text = lower(name);
  const bool travels = std::ranges::any_of(quantity_words, [&](const QuantityWord& known) {
    return known.quantity == extension && contains(text, known.word, known.match);
  });
  const Quantity named = quantity_of_name(name);
  // ISO 527: nominal strain is that between the grips.
  const bool between_grips = travels || contains(text, "nominal", Match::anywhere);
  return (named == strain && between_grips && unit != Dimension::length) ||
         (named == extension && unit == Dimension::strain);
}

std::string_view doubt_of(std::string_view name, std::optional<Dimension> unit) {
  const std::string text = lower(name);
  if (contains(text, "absol", Match::anywhere)) return "an absolute position";
  if (contains_any(text, true_words)) return "true and not engineering";
  if (is_crosshead_strain(name, unit))
    return "the crosshead's by its name, with the compliance of the machine in it";
  return {};
}

bool is_result(std::string_view name) {
  return contains_any(lower(name), result_words);
}

}  // namespace havers::io
