#include "tools/terrain/void_fill_plate.hpp"

#include <algorithm>
#include <numeric>

namespace eyepoint::tools {

namespace {

double squared_norm(std::span<const double> values) {
    return std::transform_reduce(values.begin(), values.end(), 0.0, std::plus<>{},
                                 [](double value) { return value * value; });
}

}  // namespace

void ThinPlate::add(std::span<const Post> posts, std::span<const float> factors) {
    Term term;
    bool wanted = false;
    for (std::size_t i = 0; i < posts.size(); ++i) {
        if (posts[i].unknown == kAbsent) return;
        if (posts[i].unknown == kKnown) {
            term.known += factors[i] * posts[i].value;
        } else {
            wanted = true;
            term.unknown[i] = posts[i].unknown;
            term.factor[i] = factors[i];
        }
    }
    if (wanted) terms_.push_back(term);
}

std::vector<double> ThinPlate::differences(std::span<const double> values, bool with_known) const {
    std::vector<double> result(terms_.size());
    for (std::size_t t = 0; t < terms_.size(); ++t) {
        const Term& term = terms_[t];
        double sum = with_known ? term.known : 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (term.unknown[i] >= 0)
                sum += term.factor[i] * values[static_cast<std::size_t>(term.unknown[i])];
        }
        result[t] = sum;
    }
    return result;
}

std::vector<double> ThinPlate::gathered(std::span<const double> residuals) const {
    std::vector<double> result(unknowns_, 0.0);
    for (std::size_t t = 0; t < terms_.size(); ++t) {
        const Term& term = terms_[t];
        for (std::size_t i = 0; i < 4; ++i) {
            if (term.unknown[i] >= 0)
                result[static_cast<std::size_t>(term.unknown[i])] += term.factor[i] * residuals[t];
        }
    }
    return result;
}

std::vector<double> ThinPlate::solve(std::vector<double> start) const {
    // Conjugate gradients on the normal equations, which are never formed. A relative gradient of 1e-4 leaves
    // centimetres on voids a kilometre across, far below what is known of the ground there.
    constexpr int kMostSteps = 2000;
    constexpr double kRelativeGradient = 1e-4;
    constexpr double kLeastGradientM = 1e-5;
    std::vector<double> values = std::move(start);
    std::vector<double> residuals = differences(values, true);
    for (double& residual : residuals) residual = -residual;
    std::vector<double> gradient = gathered(residuals);
    std::vector<double> direction = gradient;
    double norm = squared_norm(gradient);
    const double enough = std::max(norm * kRelativeGradient * kRelativeGradient,
                                   static_cast<double>(unknowns_) * kLeastGradientM * kLeastGradientM);
    for (int step = 0; step < kMostSteps && norm > enough; ++step) {
        const std::vector<double> image = differences(direction, false);
        const double curvature = squared_norm(image);
        if (curvature <= 0.0) break;
        const double length = norm / curvature;
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += length * direction[i];
        for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i] -= length * image[i];
        gradient = gathered(residuals);
        const double next = squared_norm(gradient);
        const double turn = next / norm;
        for (std::size_t i = 0; i < direction.size(); ++i) direction[i] = gradient[i] + turn * direction[i];
        norm = next;
    }
    return values;
}

}  // namespace eyepoint::tools
