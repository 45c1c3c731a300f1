/// A set of the nodes of one block, a bit a code.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "terrain/lod/bintree/block_triangles.hpp"

namespace eyepoint::terrain::bintree {

/// Of nodes that can be split. 256 bytes.
class CodeSet {
  public:
    [[nodiscard]] bool has(Code code) const { return (words_[code / 64] >> (code % 64) & 1U) != 0; }
    void insert(Code code) { words_[code / 64] |= std::uint64_t{1} << (code % 64); }
    void erase(Code code) { words_[code / 64] &= ~(std::uint64_t{1} << (code % 64)); }
    [[nodiscard]] std::uint32_t size() const {
        int count = 0;
        for (const std::uint64_t word : words_) count += std::popcount(word);
        return static_cast<std::uint32_t>(count);
    }
    /// Those of this set that another lacks.
    [[nodiscard]] CodeSet without(const CodeSet& other) const {
        CodeSet rest;
        for (std::size_t i = 0; i < words_.size(); ++i) rest.words_[i] = words_[i] & ~other.words_[i];
        return rest;
    }
    bool operator==(const CodeSet&) const = default;

    /// Rising, so parents before children.
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (Code word = 0; word < words_.size(); ++word) visit_word(word, words_[word], visit);
    }
    template <typename Visit>
    void for_each_of_level(int level, const Visit& visit) const {
        const Code first = Code{2} << level;
        if (first < 64) {
            const std::uint64_t mask = ((std::uint64_t{1} << first) - 1) << first;
            return visit_word(0, words_[0] & mask, visit);
        }
        for (Code word = first / 64; word < first / 32; ++word) visit_word(word, words_[word], visit);
    }

  private:
    template <typename Visit>
    static void visit_word(Code word, std::uint64_t bits, const Visit& visit) {
        for (; bits != 0; bits &= bits - 1) visit(word * 64 + static_cast<Code>(std::countr_zero(bits)));
    }

    std::array<std::uint64_t, kSplitCodesEnd / 64> words_{};
};

}  // namespace eyepoint::terrain::bintree
