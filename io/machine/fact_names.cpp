#include "io/machine/fact_names.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "io/machine/units.hpp"
#include "io/machine/words.hpp"

namespace havers::io {
namespace {

struct FactWord {
  std::string_view key;
  Fact fact;
};

// Compared with whole keys, in lower case: "Final width" is not the width.
using enum Fact;
constexpr std::array fact_words{
    FactWord{"specimen id", specimen_id},
    FactWord{"specimen label", specimen_id},
    FactWord{"specimen name", specimen_id},
    FactWord{"sample id", specimen_id},
    FactWord{"sample label", specimen_id},
    FactWord{"sample name", specimen_id},
    FactWord{"éprouvette", specimen_id},
    FactWord{"probe", specimen_id},
    FactWord{"probenbezeichnung", specimen_id},
    FactWord{"probenname", specimen_id},
    FactWord{"proben-id", specimen_id},
    FactWord{"probeta", specimen_id},
    FactWord{"provino", specimen_id},
    FactWord{"próbka", specimen_id},
    FactWord{"试样", specimen_id},
    FactWord{"width", width},
    FactWord{"specimen width", width},
    FactWord{"largeur", width},
    FactWord{"largeur éprouvette", width},
    FactWord{"breite", width},
    FactWord{"breite b0", width},
    FactWord{"ancho", width},
    FactWord{"larghezza", width},
    FactWord{"szerokość", width},
    FactWord{"largura", width},
    FactWord{"宽度", width},
    FactWord{"thickness", thickness},
    FactWord{"specimen thickness", thickness},
    FactWord{"épaisseur", thickness},
    FactWord{"épaisseur éprouvette", thickness},
    FactWord{"dicke", thickness},
    FactWord{"dicke a0", thickness},
    FactWord{"espesor", thickness},
    FactWord{"spessore", thickness},
    FactWord{"grubość", thickness},
    FactWord{"espessura", thickness},
    FactWord{"厚度", thickness},
    FactWord{"length", length},
    FactWord{"gauge length", gauge_length},
    FactWord{"gage length", gauge_length},
    FactWord{"gage length, standard travel", gauge_length},
    FactWord{"l0 - course standard", gauge_length},
    FactWord{"longueur", length},
    FactWord{"longueur initiale", gauge_length},
    FactWord{"messlänge", gauge_length},
    FactWord{"messlänge l0", gauge_length},
    FactWord{"anfangsmesslänge", gauge_length},
    FactWord{"longitud", length},
    FactWord{"lunghezza", length},
    FactWord{"długość", length},
    FactWord{"comprimento", length},
    FactWord{"标距", gauge_length},
    FactWord{"extensometer gauge length", extensometer_length},
    FactWord{"extensometer gage length", extensometer_length},
    FactWord{"diameter", diameter},
    FactWord{"specimen diameter", diameter},
    FactWord{"durchmesser", diameter},
    FactWord{"diamètre", diameter},
    FactWord{"area", area},
    FactWord{"cross-section", area},
    FactWord{"cross-sectional area", area},
    FactWord{"cross sectional area", area},
    FactWord{"section", area},
    FactWord{"querschnitt", area},
};

// What a heading calls a specimen, and what stands before its number. Of two words for a number
// that begin alike the longer stands first.
constexpr std::array<std::string_view, 16> specimen_words{
    "specimen",   "sample",      "test",    "probe",     "prüfkörper", "proben",
    "éprouvette", "échantillon", "probeta", "muestra",   "provino",    "campione",
    "próbka",     "provete",     "试样",    "test piece"};
constexpr std::array<std::string_view, 10> number_words{"number", "nummer", "numéro", "no.", "nr.",
                                                        "n°",     "nº",     "#",      "no",  "nr"};

bool is_or_begins_apart(std::string_view text) {
  return text.empty() || text.front() == ' ';
}

// What stands behind the words for a specimen and its number: "4" of "specimen no. 4", nothing in
// an empty text behind "probe nr.".
std::optional<std::string_view> behind_specimen(std::string_view text) {
  for (const std::string_view word : specimen_words) {
    if (!text.starts_with(word) || !is_or_begins_apart(text.substr(word.size()))) continue;
    const std::string_view rest = without_blanks(text.substr(word.size()));
    for (const std::string_view number : number_words)
      if (rest.starts_with(number) &&
          // "Nr.4" needs no blank after its mark; after a letter one is needed, as in "no 4", so
          // that "notes" is not taken for "no".
          (number.back() < 'a' || is_or_begins_apart(rest.substr(number.size()))))
        return without_blanks(rest.substr(number.size()));
    return rest;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Fact> fact_of_key(std::string_view key) {
  // Of "Geometry : Width" the group before the colon is left out.
  if (const std::size_t group = key.rfind(" : "); group != std::string_view::npos)
    key.remove_prefix(group + 3);
  while (key.ends_with(':') || key.ends_with(' ')) key.remove_suffix(1);
  const std::string text = lower(key);
  const auto* found = std::ranges::find(fact_words, text, &FactWord::key);
  if (found != fact_words.end()) return found->fact;
  // "Test" alone is no key for a specimen's number.
  if (text != "test" && behind_specimen(text) == "") return specimen_number;
  return std::nullopt;
}

std::string_view name_in_heading(std::string_view heading) {
  heading = without_blanks(heading);
  const std::string text = lower(heading);
  // `lower` keeps the number of bytes, so that the name is the heading's own end.
  const std::size_t length = behind_specimen(text).value_or("").size();
  const std::string_view name = heading.substr(heading.size() - length);
  constexpr std::size_t longest_word = 2;  // "B2"; a longer one has a digit, and is alone
  const bool is_name =
      name.size() <= longest_word || name.find_first_of("0123456789") != std::string_view::npos;
  return is_name && name.find(' ') == std::string_view::npos ? name : std::string_view();
}

}  // namespace havers::io
