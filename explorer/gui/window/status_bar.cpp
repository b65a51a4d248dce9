// SPDX-License-Identifier: Apache-2.0
#include "window/status_bar.hpp"

#include "model/agent_text.hpp"
#include "model/value_text.hpp"
#include "style/shapes.hpp"
#include "widgets/link.hpp"
#include "widgets/text_label.hpp"

#include <QAbstractButton>
#include <QHBoxLayout>
#include <QPainter>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int agentsShown = 3;
constexpr int threeDigits = 888;  // what room is kept for

// One agent in few words: the worst that can be said of it.
QString shortText(const AgentFrame& agent) {
    const comms::AgentStatus& s = agent.status;
    const QString name = QString::fromStdString(s.name);
    if (s.ended) return StatusBar::tr("%1 ended").arg(name);
    if (agent.lost()) return StatusBar::tr("%1 lost for %2").arg(name, ageText(s.age));
    if (!s.standstill.empty()) return name + ' ' + QString::fromStdString(s.standstill);
    if (s.missing > 0) return StatusBar::tr("%1 incomplete: %2").arg(name, cameText(s));
    return name + ' ' + (s.overloaded ? overloadText(s) : rateText(s));
}

}  // namespace

// A count with its mark and its word, in a hue from one on. Pressed, it goes to the next one.
class StatusBar::Counter : public QAbstractButton {
public:
    struct Dress {
        Shape shape;
        QColor Tokens::* back;
        QColor Tokens::* ink;
        QColor Tokens::* edge;
    };
    explicit Counter(const Dress& dress) : dress_{dress} {
        setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
        setToolTip(tr("Goes to the next one (F8)"));
        setFocusPolicy(Qt::TabFocus);
    }

    // `widest`: whose room it keeps, so that it moves nothing when its count grows.
    void show(int count, const QString& text, const QString& widest) {
        if (text == this->text()) return;
        count_ = count;
        widest_ = widest;
        setText(text);
        setAccessibleName(text);
        updateGeometry();
    }

    QSize sizeHint() const override {
        const QFontMetrics metrics{Look::font(TextSize::Note, true)};
        const int wide =
            std::max(metrics.horizontalAdvance(text()), metrics.horizontalAdvance(widest_));
        return {wide + Look::units(8), std::max(Look::units(5), metrics.height())};
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        const Tokens& c = Look::colours();
        const bool any = count_ > 0;
        QPainter painter{this};
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(hasFocus() ? QPen{c.accent, 2} : QPen{any ? c.*dress_.edge : c.border, 1});
        painter.setBrush(any ? c.*dress_.back : c.window);
        painter.drawRoundedRect(QRectF{rect()}.adjusted(0.5, 0.5, -0.5, -0.5), Look::units(1),
                                Look::units(1));
        const int size = Look::units(3);
        Tokens marks = c;
        if (any) marks.fault = marks.onFault, marks.onFault = c.fault;
        if (!any) {
            marks.fault = marks.data = marks.warnEdge = c.border;
            marks.onFault = c.window;
        }
        gui::paint(painter, QRectF(Look::units(1.5), (height() - size) / 2.0, size, size),
                   dress_.shape, marks);
        painter.setFont(Look::font(TextSize::Note, any));
        painter.setPen(any ? c.*dress_.ink : c.ink2);
        painter.drawText(rect().adjusted(Look::units(6), 0, 0, 0), Qt::AlignVCenter, text());
    }

private:
    Dress dress_;
    int count_ = 0;
    QString widest_;
};

StatusBar::StatusBar(QWidget* parent)
    : QWidget{parent},
      counters_{
          new Counter{{Shape::Fault, &Tokens::fault, &Tokens::onFault, &Tokens::fault}},
          new Counter{{Shape::AboveLimit, &Tokens::warnBg, &Tokens::warnText, &Tokens::warnEdge}},
          new Counter{{Shape::Lost, &Tokens::dataBg, &Tokens::dataText, &Tokens::data}}},
      domain_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      agents_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      security_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      more_{new Link{{}, TextSize::Note}} {
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(Look::units(3), Look::units(0.75), Look::units(3), Look::units(0.75));
    row->setSpacing(Look::units(4));
    for (const auto kind : {Abnormal::Fault, Abnormal::Outside, Abnormal::Lost}) {
        row->addWidget(counters_[kind]);
        connect(counters_[kind], &QAbstractButton::clicked, this,
                [this, kind] { Q_EMIT nextWanted(kind); });
    }
    row->addWidget(domain_);
    row->addWidget(agents_);
    row->addWidget(more_);
    more_->setToolTip(tr("Opens the table of all agents"));
    connect(more_, &Link::clicked, this, &StatusBar::agentsWanted);
    row->addWidget(security_);
    row->addStretch(1);
}

void StatusBar::refresh(const Frame& frame, const Abnormal& abnormal) {
    const int faults = abnormal.count(Abnormal::Fault), outside = abnormal.count(Abnormal::Outside),
              lost = abnormal.count(Abnormal::Lost);
    counters_[Abnormal::Fault]->show(faults, tr("%n faults", nullptr, faults),
                                     tr("%n faults", nullptr, threeDigits));
    counters_[Abnormal::Outside]->show(outside, tr("%1 outside limits").arg(outside),
                                       tr("%1 outside limits").arg(threeDigits));
    counters_[Abnormal::Lost]->show(lost, tr("%1 lost").arg(lost), tr("%1 lost").arg(threeDigits));
    domain_->show(tr("Domain %1").arg(frame.domain));
    security_->show(frame.security.empty() ? tr("Security: none") : tr("Security: on"));
    std::vector<const AgentFrame*> agents;
    for (const AgentFrame& each : frame.agents) agents.push_back(&each);
    std::ranges::sort(agents, {}, [](const AgentFrame* each) {
        return std::make_pair(troubleRank(*each), std::string_view{each->status.name});
    });
    QStringList texts;
    for (const AgentFrame* each : agents) texts << shortText(*each);
    fit(texts);
}

// "+3", or "3 agents" where none is named and there is room. Returns the room that it needs.
int StatusBar::showMore(int left, bool brief) {
    const QString words = left == 0 ? QString{} : tr("%n agents", nullptr, left);
    more_->setText(left == 0 || !brief ? words : tr("+%1").arg(left));
    more_->setAccessibleName(words);
    more_->setFixedHeight(counters_[Abnormal::Fault]->sizeHint().height());
    more_->updateGeometry();
    return left == 0 ? 0 : more_->sizeHint().width() + layout()->spacing();
}

// What has no room is left out, not cut: security first, then the agents that are well, then how
// many there are, then the domain.
void StatusBar::fit(const QStringList& agents) {
    const int gap = layout()->spacing();
    const QMargins margins = layout()->contentsMargins();
    int room = width() - margins.left() - margins.right();
    for (const Counter* each : counters_) room -= each->sizeHint().width() + gap;
    const int domain = domain_->sizeHint().width(), security = security_->sizeHint().width() + gap;
    domain_->setVisible(domain <= room);
    room -= domain + gap;
    const auto all = static_cast<int>(agents.size());
    const auto textOf = [&](int count) {
        return QStringList{agents.mid(0, count)}.join(QStringLiteral("   "));
    };
    const QFontMetrics metrics{agents_->font()};
    const auto fits = [&](int count, int left) {
        return metrics.horizontalAdvance(textOf(count)) + 2 + showMore(all - count, count > 0) <=
               left;
    };
    int count = std::min(all, agentsShown);
    const bool withSecurity = fits(count, room - security);
    while (!withSecurity && count > 0 && !fits(count, room)) --count;
    agents_->show(textOf(count));
    const bool seen = fits(count, room) || (count == 0 && showMore(all, true) <= room);
    agents_->setVisible(seen && count > 0);
    more_->setVisible(seen && count < all);
    security_->setVisible(withSecurity);
}

void StatusBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().window);
    painter.fillRect(QRect{0, 0, width(), 1}, Look::colours().line);
}

}  // namespace cortex::gui
