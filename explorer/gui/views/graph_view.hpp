// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/system_graph.hpp"

#include <QWidget>
#include <memory>
#include <string>

namespace cortex::gui {

class GraphCanvas;
class TextLabel;

// All related simplexes in the order in which values flow, from left to right. What is delayed
// goes back below.
class GraphView : public QWidget {
    Q_OBJECT
public:
    explicit GraphView(QWidget* parent = nullptr);

    void refresh(const std::shared_ptr<const Frame>& frame);
    void select(const std::string& path);
    const SystemGraph& graph() const;

Q_SIGNALS:
    void opened(const std::string& path);

private:
    void tell();

    GraphCanvas* canvas_;
    TextLabel* text_;
};

}  // namespace cortex::gui
