// SPDX-License-Identifier: Apache-2.0
#include "widgets/value_field.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "style/explorer_style.hpp"
#include "style/look.hpp"

#include <QButtonGroup>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>
#include <QWheelEvent>

namespace cortex::gui {

namespace {

constexpr std::size_t mostButtons = 4;

// The wheel scrolls the page, and never chooses.
class QuietList : public QComboBox {
protected:
    void wheelEvent(QWheelEvent* event) override { event->ignore(); }
};

QStringList labelsFor(const DataItem& item) {
    QStringList texts;
    for (const auto& [number, label] : choicesOf(item)) texts << label;
    return texts;
}

}  // namespace

ValueField::ValueField(const DataItem& item, QWidget* parent) : QWidget{parent}, item_{item} {
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(Look::units(1));
    if (labelsFor(item_).isEmpty())
        addField();
    else
        addChoices();
    setAccessibleName(QString::fromStdString(item_.name));
}

void ValueField::addChoices() {
    const QStringList choices = labelsFor(item_);
    const QString first = item_.hasDefault ? entryText(item_, item_.initial) : QString{};
    if (static_cast<std::size_t>(choices.size()) > mostButtons) {
        list_ = new QuietList;
        list_->setFocusPolicy(Qt::StrongFocus);
        if (first.isEmpty()) list_->addItem({});
        list_->addItems(choices);
        list_->setCurrentText(first);
        layout()->addWidget(list_);
        setFocusProxy(list_);
        connect(list_, qOverload<int>(&QComboBox::currentIndexChanged), this, &ValueField::changed);
        return;
    }
    buttons_ = new QButtonGroup{this};
    for (int i = 0; i < choices.size(); ++i) {
        // Without this an "&" would be a key, and not be shown.
        auto* button = new QPushButton{QString{choices[i]}.replace('&', QStringLiteral("&&"))};
        button->setCheckable(true);
        button->setChecked(choices[i] == first);
        buttons_->addButton(button, i);
        layout()->addWidget(button);
    }
    static_cast<QHBoxLayout*>(layout())->addStretch(1);
    goToChosen();
    connect(buttons_, qOverload<QAbstractButton*>(&QButtonGroup::buttonClicked), this, [this] {
        goToChosen();
        Q_EMIT changed();
    });
}

// The keyboard comes to the one that is chosen.
void ValueField::goToChosen() {
    QAbstractButton* chosen = buttons_->checkedButton();
    setFocusProxy(chosen != nullptr ? chosen : buttons_->buttons().front());
}

void ValueField::addField() {
    field_ = new QLineEdit;
    field_->setAccessibleName(QString::fromStdString(item_.name));
    if (item_.hasDefault) field_->setPlaceholderText(visibleText(entryText(item_, item_.initial)));
    if (item_.length > 1) {
        field_->setToolTip(
            tr("%n values with blanks between them", nullptr, static_cast<int>(item_.length)));
    }
    field_->setTextMargins(Look::units(1), 0, Look::units(1), 0);
    layout()->addWidget(field_);
    setFocusProxy(field_);
    connect(field_, &QLineEdit::textChanged, this, [this] {
        field_->setProperty(wrongInput, !problem().isEmpty());
        field_->update();
        Q_EMIT changed();
    });
}

QString ValueField::text() const {
    if (field_ != nullptr) return field_->text();
    if (list_ != nullptr) return list_->currentText();
    return labelsFor(item_).value(buttons_->checkedId());
}

void ValueField::setText(const QString& text) {
    if (field_ != nullptr) field_->setText(text);
    if (list_ != nullptr) list_->setCurrentText(text);
    if (buttons_ == nullptr) return;
    const int chosen = labelsFor(item_).indexOf(text);
    if (chosen >= 0) buttons_->button(chosen)->setChecked(true);
    goToChosen();
    Q_EMIT changed();
}

bool ValueField::isEmpty() const { return text().isEmpty(); }

std::optional<Value> ValueField::value() const {
    QString why;
    return isEmpty() ? std::nullopt : enteredValue(item_, text(), why);
}

QString ValueField::problem() const {
    QString why;
    if (!isEmpty()) (void)enteredValue(item_, text(), why);
    return why;
}

}  // namespace cortex::gui
