/// The goals by number, and which of them are asked for.
#pragma once

#include <array>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace eyepoint::tools {

struct GoalSubject {
    int number = 0;
    std::string_view what;
};

inline constexpr std::array kGoalSubjects{
    GoalSubject{1, "triangles at a given post error"},
    GoalSubject{2, "post error, holes and cracks"},
    GoalSubject{3, "frame CPU against tile"},
    GoalSubject{4, "what selection takes"},
    GoalSubject{5, "what morphing takes, and jumps that it leaves"},
    GoalSubject{6, "unfolding, storing and making meshes"},
    GoalSubject{7, "heap allocations in selection"},
    GoalSubject{8, "frame CPU against the floor"},
    GoalSubject{9, "what horizon culling saves and takes"},
    GoalSubject{10, "price of level of detail, slowest frames over the median, first uses of state"},
    GoalSubject{11, "reading a frame back"},
    GoalSubject{12, "frame thread outside GL: time and heap allocations"},
    GoalSubject{13, "CPU of an idle program"},
    GoalSubject{14, "tolerance control"},
    GoalSubject{15, "transport delay"},
    GoalSubject{16, "selective: what its cache saves and misses"},
    GoalSubject{17, "bintree: memory, and blocks in time"},
    GoalSubject{18, "hyperblock: against its twin by vertex, and at all tolerances"},
    GoalSubject{19, "the default against the published methods"},
};

/// Numbers of goals.
class GoalChoice {
  public:
    /// All of them.
    GoalChoice();
    explicit GoalChoice(std::set<int> numbers) : numbers_(std::move(numbers)) {}
    /// "3,8": numbers with commas between. On failure (not a number of a goal): one sentence.
    [[nodiscard]] static tl::expected<GoalChoice, std::string> parse(const std::string& text);

    [[nodiscard]] bool has(int goal) const { return numbers_.contains(goal); }
    [[nodiscard]] bool has_any(std::span<const int> goals) const;

  private:
    std::set<int> numbers_;
};

}  // namespace eyepoint::tools
