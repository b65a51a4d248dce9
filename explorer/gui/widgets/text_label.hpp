// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/look.hpp"

#include <QLabel>

namespace cortex::gui {

// One line of plain text in a size and a colour of the tokens. What does not fit ends with "…" and
// is whole in the tooltip; markup in it is text. With setWordWrap() it takes more lines instead.
class TextLabel : public QLabel {
    Q_OBJECT
public:
    explicit TextLabel(TextSize size = TextSize::Text, bool strong = false,
                       QColor Tokens::* colour = &Tokens::ink, QWidget* parent = nullptr);

    void show(const QString& text);
    void show(const QString& text, QColor Tokens::* colour);

    // In the tooltip, also where nothing of the text is cut.
    void explain(const QString& tip);
    void keepWhole() { whole_ = true; }         // never cut: what is beside it gives way
    void keepEnd() { elide_ = Qt::ElideLeft; }  // paths differ at their ends
    void setTextSize(TextSize size, bool strong);
    bool keepsWhole() const { return whole_ || wordWrap(); }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;
    int heightForWidth(int width) const override;  // with all its lines
    int heightOfLines(int count) const;
    bool fits(const QString& text) const;  // in its lines

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void paintLines(QPainter& painter);
    void dress();  // in the look that applies now

    TextSize size_;
    bool strong_;
    QColor Tokens::* colour_;
    QString tip_;
    Qt::TextElideMode elide_ = Qt::ElideRight;
    bool dressing_ = false, whole_ = false;
};

}  // namespace cortex::gui
