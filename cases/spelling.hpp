#pragma once
// "did you mean": the nearest of a list of words.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace puffin::cases {

/// Edits (insert, delete, replace, swap of neighbours) that turn one word into the other: the restricted
/// Damerau-Levenshtein distance. Cost: product of the lengths.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word` if it is near enough to be a slip (a third of its length, at least 1), else "".
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// The end of a message about a word that is none of the candidates: "; did you mean 'b'?", or "" if none is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// The same, with "; known: a, b, c" if none is near.
std::string did_you_mean_or_known(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c".
std::string join(std::span<const std::string> words);

}  // namespace puffin::cases
