// SPDX-License-Identifier: Apache-2.0
#include "views/graph_view.hpp"

#include "style/look.hpp"
#include "views/graph_canvas.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

namespace cortex::gui {

GraphView::GraphView(QWidget* parent)
    : QWidget{parent},
      canvas_{new GraphCanvas},
      text_{new TextLabel{TextSize::Text, false, &Tokens::ink2}} {
    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(Look::units(4), Look::units(2), Look::units(3), Look::units(2));
    bar->setSpacing(Look::units(2));
    text_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    bar->addWidget(text_, 1);
    const auto button = [&](const QString& text, const QString& tip, auto&& action) {
        auto* made = new QPushButton{text};
        made->setToolTip(tip);
        made->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
        connect(made, &QPushButton::clicked, this, action);
        bar->addWidget(made);
    };
    button(tr("Fold all"), tr("Shows families of like simplexes as one node each"),
           [this] { canvas_->foldAll(); });
    button(tr("Show all"), tr("Zooms so that everything is seen (F)"), [this] { canvas_->fit(); });
    auto* column = new QVBoxLayout{this};
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(bar);
    column->addWidget(canvas_, 1);
    connect(canvas_, &GraphCanvas::opened, this, &GraphView::opened);
    connect(canvas_, &GraphCanvas::changed, this, &GraphView::tell);
}

void GraphView::refresh(const std::shared_ptr<const Frame>& frame) { canvas_->refresh(frame); }

void GraphView::select(const std::string& path) {
    const std::uint32_t node = graph().find(path);
    if (node != noSimplex) canvas_->select(node);
}

const SystemGraph& GraphView::graph() const { return canvas_->graph(); }

void GraphView::tell() {
    const SystemGraph& shown = graph();
    QString text = shown.nodes.empty()
                       ? tr("Nothing that is heard is related to anything.")
                       : tr("%1 nodes, %2 relationships. Values flow to the right; delayed ones "
                            "are dashed.")
                             .arg(shown.nodes.size())
                             .arg(shown.edges.size());
    if (shown.unrelated > 0) {
        text += tr(" %1 unrelated are not drawn.").arg(shown.unrelated);
    }
    text_->show(text);
}

}  // namespace cortex::gui
