#include "tools/bench/goals/callgrind_profile.hpp"

#include <cctype>
#include <cstdlib>

namespace eyepoint::tools {

namespace {

/// Names stand once, behind their number: "(7) name", then "(7)".
class Names {
  public:
    const std::string& of(const std::string& text) {
        const auto end = text.find(')');
        if (text.empty() || text.front() != '(' || end == std::string::npos) return named_[text] = text;
        std::string& name = named_[text.substr(0, end + 1)];
        if (end + 2 < text.size()) name = text.substr(end + 2);
        return name;
    }

  private:
    std::map<std::string, std::string> named_;
};

/// "12 345", "+3 345", "* 345": a place and its cost.
bool is_cost(const std::string& line) {
    return !line.empty() && (std::isdigit(static_cast<unsigned char>(line.front())) != 0 ||
                             line.front() == '+' || line.front() == '-' || line.front() == '*');
}

/// Calls visit(function, callee, instructions): callee is nullptr where they are the function's own.
template <typename Visit>
void for_each_cost(std::istream& profile, const Visit& visit) {
    Names names;
    std::string function, callee;
    bool of_callee = false;
    for (std::string line; std::getline(profile, line);) {
        if (line.starts_with("fn=")) {
            function = names.of(line.substr(3));
        } else if (line.starts_with("cfn=")) {
            callee = names.of(line.substr(4));
        } else if (line.starts_with("calls=")) {
            of_callee = true;
        } else if (is_cost(line) && line.find(' ') != std::string::npos) {
            const std::uint64_t cost = std::strtoull(line.c_str() + line.find(' '), nullptr, 10);
            visit(function, of_callee ? &callee : nullptr, cost);
            of_callee = false;
        }
    }
}

}  // namespace

std::map<std::string, std::uint64_t> instructions_by_function(std::istream& profile) {
    std::map<std::string, std::uint64_t> instructions;
    for_each_cost(profile, [&](const std::string& function, const std::string* callee, std::uint64_t cost) {
        if (callee == nullptr) instructions[function] += cost;
    });
    return instructions;
}

std::uint64_t instructions_of_calls(std::istream& profile, std::string_view name) {
    const auto named = [&](const std::string& function) { return function.find(name) != std::string::npos; };
    std::uint64_t instructions = 0;
    for_each_cost(profile, [&](const std::string& function, const std::string* callee, std::uint64_t cost) {
        if (callee != nullptr && named(*callee) && !named(function)) instructions += cost;
    });
    return instructions;
}

}  // namespace eyepoint::tools
