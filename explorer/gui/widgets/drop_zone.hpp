// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <QWidget>

namespace cortex::gui {

// Where what is dragged would go, outlined over what is there, and what would become of it in
// words: "add to position (rad)".
class DropZone : public QWidget {
    Q_OBJECT
public:
    explicit DropZone(QWidget* over);

    void show(const QRect& box, const QString& words, bool allowed = true);  // in what is below
    const QString& words() const { return words_; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString words_;
    bool allowed_ = true;
};

}  // namespace cortex::gui
