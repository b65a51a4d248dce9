// SPDX-License-Identifier: Apache-2.0
#include "drive/link_row.hpp"

#include "drive/mark.hpp"
#include "drive/path_button.hpp"
#include "motion/labels.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <array>

namespace cortex::explorer {

namespace {

constexpr double wideRow = 235, narrowRow = 170;  // units; what is said takes more lines below them

// By the labels of the item `link`.
struct LinkState {
    const char* word;
    MarkShape mark;
    std::optional<Tone> tone;
};
constexpr std::array<LinkState, 4> linkStates{
    {{QT_TRANSLATE_NOOP("cortex::explorer::LinkRow", "Link closed"), MarkShape::Triangle,
      Tone::Limit},
     {QT_TRANSLATE_NOOP("cortex::explorer::LinkRow", "Link connecting"), MarkShape::Ring,
      std::nullopt},
     {QT_TRANSLATE_NOOP("cortex::explorer::LinkRow", "Link open"), MarkShape::Disc, std::nullopt},
     {QT_TRANSLATE_NOOP("cortex::explorer::LinkRow", "Link refused"), MarkShape::Octagon,
      Tone::Fault}}};

class LinkMark : public QWidget {
public:
    LinkMark() { fit(); }
    void show(MarkShape shape) {
        if (shape == shape_) return;
        shape_ = shape;
        update();
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter{this};
        painter.setRenderHint(QPainter::Antialiasing);
        paintMark(painter, QRectF{rect()}.adjusted(1, 1, -1, -1), shape_, palette());
    }
    void changeEvent(QEvent* event) override {
        QWidget::changeEvent(event);
        if (event->type() == QEvent::StyleChange) fit();
    }

private:
    void fit() { setFixedSize(units(3.5), units(3.5)); }

    MarkShape shape_ = MarkShape::DashedRing;
};

// "3.1 ms old; an answer counts for 50 ms".
QString ageOf(const SimplexNow& device) {
    const auto loss = device.number("lossTime");
    const QString age = device.text("age");
    if (!loss) return LinkRow::tr("last answer %1 ms ago").arg(age);
    return LinkRow::tr("last answer %1 ms ago, of %2 ms").arg(age).arg(*loss * 1000, 0, 'g', 4);
}

QString factsOf(const SimplexNow& device) {
    const auto part = [&](const char* item, const QString& words) {
        return words.arg(device.text(item));
    };
    QStringList parts;
    const QString address = device.text("address");
    if (address != QStringLiteral("—")) parts << address;
    parts << ageOf(device) << part("lateCount", LinkRow::tr("%1 late"))
          << part("errorCount", LinkRow::tr("%1 errors"))
          << part("reconnectCount", LinkRow::tr("%1 reconnects"))
          << part("exchangeTimeP99", LinkRow::tr("P99 %1 µs"));
    return parts.join(QStringLiteral("   "));
}

bool isTooOld(const SimplexNow& device) {
    const auto age = device.number("age"), loss = device.number("lossTime");
    return age && loss && *age > *loss * 1000;
}

}  // namespace

LinkRow::LinkRow(std::string device, bool names, QWidget* parent)
    : QWidget{parent},
      device_{std::move(device)},
      mark_{new LinkMark},
      word_{new QLabel},
      path_{new PathButton},
      facts_{new Sentence},
      reconnect_{new QPushButton{tr("Reconnect")}} {
    auto* row = new QHBoxLayout;
    row->setSpacing(units(2));
    for (QWidget* each : std::initializer_list<QWidget*>{mark_, word_, path_}) row->addWidget(each);
    row->addWidget(facts_, 1);
    row->addWidget(reconnect_);
    path_->show(names ? QString::fromStdString(device_) : QString{});
    connect(path_, &PathButton::opened, this, &LinkRow::opened);
    connect(reconnect_, &QPushButton::clicked, this, &LinkRow::reconnectWanted);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(units(2), 0, units(2), units(0.25));
    rows->setSpacing(0);
    rows->addLayout(row);
    dress();
}

void LinkRow::refresh(const SystemNow& now, const QString& whyNoReconnect) {
    const SimplexNow device = now.at(device_);
    const auto link = device.number("link");
    const bool live = device.live() || (device.state() && link);  // it measures at rest, too
    const auto at = link ? static_cast<std::size_t>(*link) : linkStates.size();
    const bool known = at < linkStates.size();
    const QString word = known ? tr(linkStates[at].word) : tr("Link unknown");
    static_cast<LinkMark*>(mark_)->show(known && live ? linkStates[at].mark
                                                      : MarkShape::DashedRing);
    word_->setText(live ? word : '[' + word + ']');
    word_->setAccessibleName(word_->text());
    QPalette colours;
    const auto tone = !live   ? std::optional{Tone::NotLive}
                      : known ? linkStates[at].tone
                              : std::nullopt;
    if (tone) colours.setColor(QPalette::WindowText, textColour(*tone));
    if (colours != word_->palette()) word_->setPalette(colours);
    known_ = factsOf(device);
    facts_->say(facts(), !live              ? std::optional{Tone::NotLive}
                         : isTooOld(device) ? std::optional{Tone::Limit}
                                            : std::nullopt);
    reconnect_->setEnabled(whyNoReconnect.isEmpty());
    reconnect_->setToolTip(whyNoReconnect);
    reconnect_->setAccessibleDescription(whyNoReconnect);
}

QString LinkRow::facts() const { return told_.isEmpty() ? known_ : told_ + '\n' + known_; }

void LinkRow::say(const QString& outcome) {
    told_ = outcome;
    facts_->say(facts());
}

void LinkRow::dress() {
    QFont strong = font();
    strong.setWeight(QFont::DemiBold);
    if (word_->font() != strong) word_->setFont(strong);
    int width = 0;  // of any word, so that none moves the path
    for (const LinkState& each : linkStates) {
        const QString word = '[' + tr(each.word) + ']';
        width = std::max(width, word_->fontMetrics().horizontalAdvance(word));
    }
    word_->setMinimumWidth(width);
    QFont small = font();
    small.setPointSizeF(font().pointSizeF() * 0.9);
    reconnect_->setFixedHeight(units(6.5));
    if (facts_->font() != small) facts_->setFont(small);
}

void LinkRow::resizeEvent(QResizeEvent* /*event*/) {
    facts_->keepLines(width() >= units(wideRow) ? 2 : width() >= units(narrowRow) ? 3 : 4);
}

void LinkRow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) dress();
}

// A line below, which parts it from what follows.
void LinkRow::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(QRect{0, height() - 1, width(), 1}, palette().color(QPalette::Mid));
}

}  // namespace cortex::explorer
