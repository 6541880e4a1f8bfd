// Numbers of names against a map that is kept beside them.
#include "schemes/numbering.h"

#include <map>

#include "tests/catch.h"
#include "tests/random.h"

namespace shaolin {

TEST_CASE("Names are numbered as they are met, however many they are", "[schemes][numbering]") {
  Random random(7);
  for (const int most : {1, 3, 1000}) {
    Numbering<3> numbers;
    std::map<Numbering<3>::Name, int> known;
    for (int i = 0; i < 5000; ++i) {
      const auto word = [&] { return static_cast<int>(random.uniform() * most) - most / 2; };
      const Numbering<3>::Name name{word() % 10, word(), i % 2};
      const int next = static_cast<int>(known.size());
      REQUIRE(numbers(name) == known.try_emplace(name, next).first->second);
      REQUIRE(numbers.size() == static_cast<int>(known.size()));
    }
  }
}

}  // namespace shaolin
