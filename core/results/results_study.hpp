#pragma once

#include <string>
#include <vector>

#include "core/results/results.hpp"

namespace mapproof {

/// What an id stands for in figures and tables.
struct Label {
  std::string id;
  std::string label;
  std::string unit = {};  ///< Of a factor's levels; empty: none.

  bool operator==(const Label&) const = default;
};

/// A study that any program can write: a title, labels and a table of results.
struct ResultsStudy {
  std::string name;      ///< [a-z][a-z0-9-]*; ids of figures and tables begin with it.
  std::string title;     ///< Of the report.
  std::string question;  ///< What was asked and how it was tried; may be empty.
  std::string compared_with = {};  ///< What the results are judged against; may be empty.
  std::string command;             ///< That made the results; may be empty.
  std::vector<std::string> quantities;          ///< Ids, in the order of tables.
  std::vector<Label> quantity_labels = {};      ///< In place of the dictionary's; may be empty.
  std::vector<Label> setups, methods, factors;  ///< In the order of tables.
  /// Of runs that are not repeats of each other, such as data sets: each has tables of its own.
  /// Empty: all stand in the same ones.
  std::vector<Label> runs = {};
  Results results;
};

/// Adds the quantities, setups, methods and factors that rows have and the lists do not: of the
/// dictionary's quantities the most informative first, else in ascending order, labelled by their
/// ids. Quantities that no row has are taken away.
/// @return The list and the id of the first label that no row has: "setups: indoors"; empty if
///         every row has one.
std::string complete(ResultsStudy& study);

/// What a reader of the table should check though it can be used, a sentence each: rows of a
/// setup that lack a factor which others of it have; a quantity in % whose values all lie in 0
/// to 1.
/// @param study  complete(), its rows in order.
std::vector<std::string> remarks_of(const ResultsStudy& study);

/// What of its labels a reader could mistake, a sentence each that begins with the list: two ids of
/// one list with the same label.
std::vector<std::string> label_remarks_of(const ResultsStudy& study);

/// The label of an id; the id itself if there is none.
std::string label_of(const std::vector<Label>& labels, const std::string& id);

}  // namespace mapproof
