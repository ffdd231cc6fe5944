// Groups items that are joined pairwise.
#pragma once

#include <numeric>
#include <vector>

namespace edgescout {

class UnionFind {
 public:
  explicit UnionFind(std::size_t items) : parent_(items) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  // The item that stands for the group.
  int root(int item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace edgescout
