// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QLineEdit>
#include <QListWidget>
#include <QPointer>
#include <cstdint>
#include <utility>
#include <vector>

namespace cortex::gui {

// All labels among which a value is entered, beside the field that has the keyboard. Up and Down
// choose another one, and so does the mouse; what is typed chooses the first that begins with it.
// It lies over what is there, so that nothing moves, and goes with the field.
class ChoiceList : public QListWidget {
    Q_OBJECT
public:
    using Choices = std::vector<std::pair<std::int64_t, QString>>;  // numbers and labels

    ChoiceList(const Choices& choices, bool numbered, QLineEdit& field);

    // The row that the text means is chosen; false: none is. `isValue`: it is one by itself.
    bool follow(const QString& text, bool isValue);
    QString chosen() const;         // what is entered for the chosen row; empty: none
    void setUseful(bool isUseful);  // shown while the field has the keyboard

Q_SIGNALS:
    void taken();  // with the mouse

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

private:
    int rowOf(const QString& text, bool isValue) const;
    bool walk(int key);
    void enter(int row);
    void fit();

    Choices choices_;
    QStringList texts_;  // what is entered for each
    QPointer<QLineEdit> field_;
    bool isUseful_ = true;
};

}  // namespace cortex::gui
