// SPDX-License-Identifier: Apache-2.0
#include "window/status_bar.hpp"

#include "model/value_text.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPainter>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr int agentsShown = 3;

// One agent in few words: the worst that can be said of it.
QString shortText(const AgentFrame& agent) {
    const comms::AgentStatus& s = agent.status;
    const QString name = QString::fromStdString(s.name);
    if (agent.lost()) return StatusBar::tr("%1 lost for %2").arg(name, ageText(s.age));
    if (!s.standstill.empty()) return name + ' ' + QString::fromStdString(s.standstill);
    if (s.missing > 0) {
        return StatusBar::tr("%1 incomplete: %2 of %3")
            .arg(name)
            .arg(s.simplexes - s.missing)
            .arg(s.simplexes);
    }
    const double rate = s.period > 0 ? 1e9 / static_cast<double>(s.period) : 0;
    return StatusBar::tr("%1 %2 Hz").arg(name).arg(rate, 0, 'g', 4);
}

int trouble(const AgentFrame& agent) {
    return agent.lost()                       ? 0
           : !agent.status.standstill.empty() ? 1
           : agent.status.missing > 0         ? 2
                                              : 3;
}

}  // namespace

// A count with its mark and its word; filled when it is a number of faults above zero.
class StatusBar::Counter : public QWidget {
public:
    Counter(Shape shape, QColor Tokens::* back, QColor Tokens::* ink, QColor Tokens::* edge)
        : shape_{shape}, back_{back}, ink_{ink}, edge_{edge} {
        setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    }

    void show(int count, const QString& text) {
        if (text == text_) return;
        count_ = count;
        text_ = text;
        setAccessibleName(text);
        updateGeometry();
        update();
    }

    QSize sizeHint() const override {
        const QFontMetrics metrics{Look::font(TextSize::Note, true)};
        return {metrics.horizontalAdvance(text_) + Look::units(8), Look::units(5)};
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        const Tokens& c = Look::colours();
        QPainter painter{this};
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen{count_ > 0 ? c.*edge_ : c.border, 1});
        painter.setBrush(count_ > 0 ? c.*back_ : c.window);
        painter.drawRoundedRect(QRectF{rect()}.adjusted(0.5, 0.5, -0.5, -0.5), Look::units(1),
                                Look::units(1));
        const int size = Look::units(3);
        Tokens marks = c;
        if (count_ > 0) marks.fault = marks.onFault, marks.onFault = c.fault;
        if (count_ == 0) marks.fault = marks.data = c.border, marks.onFault = c.window;
        explorer::paint(painter, QRectF(Look::units(1.5), (height() - size) / 2.0, size, size),
                        shape_, marks);
        painter.setFont(Look::font(TextSize::Note, count_ > 0));
        painter.setPen(count_ > 0 ? c.*ink_ : c.ink2);
        painter.drawText(rect().adjusted(Look::units(6), 0, 0, 0), Qt::AlignVCenter, text_);
    }

private:
    Shape shape_;
    QColor Tokens::* back_;
    QColor Tokens::* ink_;
    QColor Tokens::* edge_;
    int count_ = 0;
    QString text_;
};

StatusBar::StatusBar(QWidget* parent)
    : QWidget{parent},
      faults_{new Counter{Shape::Fault, &Tokens::fault, &Tokens::onFault, &Tokens::fault}},
      lost_{new Counter{Shape::Lost, &Tokens::dataBg, &Tokens::dataText, &Tokens::data}},
      domain_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      agents_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      security_{new TextLabel{TextSize::Note, false, &Tokens::ink2}} {
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(Look::units(3), Look::units(0.75), Look::units(3), Look::units(0.75));
    row->setSpacing(Look::units(4));
    row->addWidget(faults_);
    row->addWidget(lost_);
    row->addWidget(domain_);
    row->addWidget(agents_);
    row->addWidget(security_);
    row->addStretch(1);
}

void StatusBar::refresh(const Frame& frame, const Marks& total) {
    faults_->show(total.faults, tr("%n faults", nullptr, total.faults));
    lost_->show(total.lost, tr("%n lost", nullptr, total.lost));
    domain_->show(tr("Domain %1").arg(frame.domain));
    security_->show(frame.security.empty() ? tr("Security: none") : tr("Security: on"));
    std::vector<const AgentFrame*> agents;
    for (const AgentFrame& each : frame.agents) agents.push_back(&each);
    std::ranges::sort(agents, {}, [](const AgentFrame* each) {
        return std::make_pair(trouble(*each), std::string_view{each->status.name});
    });
    QStringList texts;
    for (std::size_t i = 0; i < std::min<std::size_t>(agents.size(), agentsShown); ++i) {
        texts << shortText(*agents[i]);
    }
    if (agents.size() > agentsShown)
        texts << QStringLiteral("+%1").arg(agents.size() - agentsShown);
    agents_->show(texts.join(QStringLiteral("   ")));
}

void StatusBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().window);
    painter.fillRect(QRect{0, 0, width(), 1}, Look::colours().line);
}

}  // namespace cortex::explorer
