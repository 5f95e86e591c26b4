#include "core/results/quantity.hpp"

#include <set>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

std::string refusal_of(const std::string& id, const std::string& unit, Better better) {
  try {
    study_quantity(id, "Label", unit, better);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(QuantityDictionary, HasEachIdOnceWithALabelAndStandInsThatItHas) {
  std::set<std::string> ids;
  for (const Quantity& quantity : all_quantities()) {
    EXPECT_TRUE(ids.insert(quantity.id).second) << quantity.id;
    EXPECT_EQ(problem_of(quantity), "") << quantity.id;
    if (!quantity.stands_in_for.empty()) {
      EXPECT_NE(find_quantity(quantity.stands_in_for), nullptr) << quantity.id;
    }
    // What is judged by nightly runs is an error, not a number of the solver.
    if (quantity.nightly == NightlyRule::kRatio || quantity.nightly == NightlyRule::kPoints) {
      EXPECT_EQ(quantity.better, Better::kLower) << quantity.id;
      EXPECT_FALSE(quantity.of_solver) << quantity.id;
    }
  }
}

TEST(QuantityDictionary, KnowsTwoOrientationErrors) {
  const Quantity& plain = known_quantity("moe_percent");
  const Quantity& reflected = known_quantity("moe_unmirrored_percent");
  EXPECT_NE(plain.label, reflected.label);
  EXPECT_NE(reflected.label.find("reflection"), std::string::npos);
}

TEST(StudyQuantity, OfAKnownIdHasTheDictionarysFactsUnderTheStudysLabel) {
  const Quantity quantity = study_quantity("mpe_m", "MPE of the pick", "m", Better::kLower);
  Quantity expected = known_quantity("mpe_m");
  expected.label = "MPE of the pick";
  EXPECT_EQ(quantity, expected);
}

TEST(StudyQuantity, WithAnotherUnitOrDirectionThanTheDictionarysIsRefusedInOneLine) {
  EXPECT_EQ(refusal_of("mpe_m", "cm", Better::kLower),
            "\"mpe_m\" is a quantity of mapproof's, in m, lower is better; it is declared in cm, "
            "lower is better here");
  EXPECT_NE(refusal_of("mpe_m", "m", Better::kHigher).find("higher is better here"),
            std::string::npos);
  EXPECT_EQ(refusal_of("mpe_m", "m", Better::kLower), "");
  EXPECT_EQ(refusal_of("my_error", "cm", Better::kHigher), "");
  for (const char* id : {"", "Upper", "1st", "with blank", "a/b", "caf\xc3\xa9"})
    EXPECT_NE(refusal_of(id, "m", Better::kLower), "") << id;
  EXPECT_NE(refusal_of("my_error", "m\x1b[31m", Better::kLower), "");
  EXPECT_NE(refusal_of("my_error", std::string(1000, 'm'), Better::kLower), "");
  EXPECT_EQ(refusal_of("my_error", "\u00b0", Better::kLower), "");
}

TEST(Quantities, HaveWhatTheStudyDeclaresBesideTheDictionary) {
  Quantities quantities;
  EXPECT_EQ(quantities.find("found_percent"), nullptr);
  EXPECT_THROW(quantities.at("found_percent"), InvalidInput);
  quantities.declare(study_quantity("found_percent", "Found", "%", Better::kHigher));
  quantities.declare(known_quantity("mpe_m"));
  ASSERT_EQ(quantities.declared().size(), 1U);  // The dictionary's need no declaration.
  EXPECT_EQ(quantities.at("found_percent").better, Better::kHigher);
  EXPECT_EQ(quantities.at("mpe_m"), known_quantity("mpe_m"));
  quantities.declare(study_quantity("found_percent", "Found again", "%", Better::kHigher));
  EXPECT_EQ(quantities.declared().size(), 1U);
  EXPECT_THROW(quantities.declare(study_quantity("found_percent", "F", "", Better::kHigher)),
               InvalidInput);
}

TEST(Quantities, ThatAreDeclaredStandAfterTheDictionary) {
  const Quantity own = study_quantity("a_first", "First", "", Better::kLower);
  for (const Quantity& quantity : all_quantities())
    EXPECT_LT(dictionary_rank(quantity), dictionary_rank(own));
  EXPECT_EQ(dictionary_rank(all_quantities().front()), 0U);
  EXPECT_EQ(label_with_unit(own), "First");
  EXPECT_EQ(label_with_unit(known_quantity("mpe_m")), "MPE [m]");
}

}  // namespace
}  // namespace mapproof
