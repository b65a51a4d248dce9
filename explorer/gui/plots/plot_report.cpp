// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_report.hpp"

#include "style/look.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

namespace cortex::gui {

namespace {

int reportEdge() { return Look::units(3); }
int titleRow(const QFontMetrics& metrics) { return metrics.height() + Look::units(0.5); }
QFontMetrics titleMetrics() { return QFontMetrics{Look::font(TextSize::Text, true)}; }

}  // namespace

PlotReport::PlotReport(QWidget& panels, QWidget* legend, const QString& range,
                       const QStringList& names)
    : panels_{panels}, legend_{legend}, title_{range} {
    if (legend_ != nullptr) legend_->resize(legend_->size().expandedTo(legend_->sizeHint()));
    addNames(names);
}

// In as many rows as they need. Only a name that is longer than a row is cut, at its begin.
void PlotReport::addNames(const QStringList& names) {
    const QFontMetrics metrics = titleMetrics();
    QString row;
    for (int i = 0; i < names.size(); ++i) {
        const QString name = names[i] + (i + 1 < names.size() ? QStringLiteral(", ") : QString{});
        if (!row.isEmpty() && metrics.horizontalAdvance(row + name) > width()) {
            title_ << row;
            row.clear();
        }
        row += name;
    }
    title_ << row;
    for (QString& each : title_) each = metrics.elidedText(each, Qt::ElideLeft, width());
}

int PlotReport::width() const {
    return panels_.width() + (legend_ == nullptr ? 0 : reportEdge() + legend_->width());
}

QSize PlotReport::size() const {
    const int below = std::max(panels_.height(), legend_ == nullptr ? 0 : legend_->height());
    const int rows = static_cast<int>(title_.size()) * titleRow(titleMetrics());
    return {width() + 2 * reportEdge(), rows + below + 3 * reportEdge()};
}

void PlotReport::paint(QPainter& painter) const {
    painter.fillRect(QRect{{}, size()}, Look::colours().surface);
    painter.setPen(Look::colours().ink);
    painter.setFont(Look::font(TextSize::Text, true));
    const int height = titleRow(titleMetrics());
    int y = reportEdge();
    for (const QString& each : title_) {
        painter.drawText(QRect{reportEdge(), y, width(), height},
                         Qt::AlignVCenter | Qt::TextSingleLine, each);
        y += height;
    }
    y += reportEdge();
    panels_.render(&painter, {reportEdge(), y}, {}, QWidget::DrawChildren);
    if (legend_ == nullptr) return;
    legend_->render(&painter, {2 * reportEdge() + panels_.width(), y}, {}, QWidget::DrawChildren);
}

}  // namespace cortex::gui
