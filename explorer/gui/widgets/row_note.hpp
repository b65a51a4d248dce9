// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

class QAbstractScrollArea;

namespace cortex::gui {

class TextLabel;

// Words over the last rows of a table or a tree, so that no row moves when they come or go.
class RowNote : public QWidget {
    Q_OBJECT
public:
    explicit RowNote(QAbstractScrollArea& rows);

    void show(const QString& text);  // without words it is hidden

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void fit();

    QAbstractScrollArea& rows_;
    TextLabel* text_;
};

}  // namespace cortex::gui
