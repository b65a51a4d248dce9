// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace cortex::gui {

// A row of the table of values, with where its value is found.
struct ItemModel::Node {
    Row row;
    Node* parent = nullptr;
    int number = 0;
    std::uint32_t agent = 0, simplex = 0;
    const ItemLayout* layout = nullptr;
    std::vector<std::unique_ptr<Node>> children;

    Node& add(Row below) {
        children.push_back(std::make_unique<Node>());
        Node& node = *children.back();
        node.row = std::move(below);
        node.parent = this;
        node.number = static_cast<int>(children.size()) - 1;
        return node;
    }
};

}  // namespace cortex::gui
