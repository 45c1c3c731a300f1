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

}  // namespace

std::map<std::string, std::uint64_t> instructions_by_function(std::istream& profile) {
    std::map<std::string, std::uint64_t> instructions;
    Names names;
    std::string function;
    bool callees = false;
    for (std::string line; std::getline(profile, line);) {
        if (line.starts_with("fn=")) {
            function = names.of(line.substr(3));
        } else if (line.starts_with("cfn=")) {
            (void)names.of(line.substr(4));
        } else if (line.starts_with("calls=")) {
            callees = true;
        } else if (is_cost(line) && line.find(' ') != std::string::npos) {
            if (!callees) instructions[function] += std::strtoull(line.c_str() + line.find(' '), nullptr, 10);
            callees = false;
        }
    }
    return instructions;
}

}  // namespace eyepoint::tools
