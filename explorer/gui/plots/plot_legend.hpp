// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/cursor_overlay.hpp"
#include "plots/drawn_line.hpp"

#include <QWidget>
#include <array>

namespace cortex::gui {

// The lines with their numbers: the value at the pointer, at the end of what is held, or the
// newest; least and greatest that are visible. Or the values at the cursors with their difference.
// Below, the statistics of the line that is chosen.
class PlotLegend : public QWidget {
    Q_OBJECT
public:
    explicit PlotLegend(QWidget* parent = nullptr);

    void show(const std::vector<DrawnLine>& lines, const Recorder& recorder, TimeSpan span,
              const Cursors& cursors, bool follows);
    void showStatistics(bool wanted);
    bool showsStatistics() const { return statistics_; }
    int chosen() const { return chosen_; }  // tag
    void choose(int tag);
    QStringList texts() const;  // of all rows, as they are shown

    QSize sizeHint() const override;

Q_SIGNALS:
    void chosenChanged(int tag);
    void menuWanted(int tag, const QPoint& global);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

private:
    struct Row {
        int tag = 0;
        QPen pen;
        QString path, item;
        std::array<QString, 3> values;
        bool wide = false;  // the first value has the whole row
        bool operator==(const Row&) const = default;
    };
    Row rowOf(const DrawnLine& line, const Recorder& recorder, TimeSpan span,
              const Cursors& cursors, std::optional<double> at) const;
    void fillFacts(const std::vector<DrawnLine>& lines, TimeSpan span, const Cursors& cursors);
    int namesWidth() const;  // of the facts
    void paintFacts(QPainter& painter, int y) const;
    int tagAt(int y) const;
    void describe();

    std::vector<Row> rows_;
    QString title_;  // of the statistics
    std::vector<std::array<QString, 2>> facts_;
    std::array<QString, 3> heads_;
    bool statistics_ = false;
    int chosen_ = 1;
};

}  // namespace cortex::gui
