// SPDX-License-Identifier: Apache-2.0
#include "gui/layout/Layout.h"
#include "gui/layout/PanelPlace.h"

#include <QtTest/QtTest>

using namespace qplc;

namespace {

constexpr QSize page(1000, 600);

QSize wantedOf(const LayoutPanel &panel)
{
    return panel.type == QLatin1String("Gauge") ? QSize(180, 150) : QSize(400, 250);
}

/// A page that is filled by adding panels where they fit.
class FilledPage
{
public:
    explicit FilledPage(const QString &first) { m_layout.addPanel(first, {}, LayoutTarget::inTab(tab())); }

    QString add(const QString &type)
    {
        return m_layout.addPanel(
            type, {}, fittingPlace(*m_layout.currentTab().tree, page, wantedOf({{}, type, {}, {}}), wantedOf));
    }
    QSize sizeOf(const QString &id) const { return sizeIn(*m_layout.currentTab().tree, QSizeF(page), id).toSize(); }
    const Layout &layout() const { return m_layout; }

private:
    QString tab() const { return m_layout.currentTab().id; }
    static QSizeF sizeIn(const LayoutNode &node, const QSizeF &size, const QString &id)
    {
        if (node.isPanel())
            return node.panel.id == id ? size : QSizeF();
        for (const LayoutNode &child : node.children) {
            const double share = double(child.share) / LayoutNode::WholeShare;
            const QSizeF part = node.orientation == Qt::Horizontal ? QSizeF(size.width() * share, size.height())
                                                                   : QSizeF(size.width(), size.height() * share);
            if (const QSizeF found = sizeIn(child, part, id); found.isValid())
                return found;
        }
        return {};
    }

    Layout m_layout;
};

}  // namespace

class tst_PanelPlace : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aNewPanelHasTheSizeThatItWants();
    void panelsShareThePageInsteadOfBecomingColumns();
    void newPanelShrinksOnlyItsNeighbour();
    void fullPageAcceptsMorePanels();
};

void tst_PanelPlace::aNewPanelHasTheSizeThatItWants()
{
    FilledPage filled(QStringLiteral("Time plot"));
    const QSize gauge = filled.sizeOf(filled.add(QStringLiteral("Gauge")));
    QVERIFY2(qAbs(gauge.width() - 180) <= 1 || qAbs(gauge.height() - 150) <= 1,
             qPrintable(QStringLiteral("%1 x %2").arg(gauge.width()).arg(gauge.height())));
    QVERIFY(gauge.width() >= 179 && gauge.height() >= 149);
}

void tst_PanelPlace::panelsShareThePageInsteadOfBecomingColumns()
{
    FilledPage filled(QStringLiteral("Time plot"));
    QStringList gauges;
    for (int i = 0; i < 4; ++i)
        gauges << filled.add(QStringLiteral("Gauge"));
    for (const QString &id : qAsConst(gauges)) {
        const QSize size = filled.sizeOf(id);
        QVERIFY2(size.width() >= 150 && size.height() >= 130 && size.height() < page.height() / 2 + 1,
                 qPrintable(QStringLiteral("%1: %2 x %3").arg(id).arg(size.width()).arg(size.height())));
    }
    const QSize plot = filled.sizeOf(QStringLiteral("panel1"));
    QVERIFY(plot.width() >= 400 && plot.height() >= 250);
}

void tst_PanelPlace::newPanelShrinksOnlyItsNeighbour()
{
    FilledPage filled(QStringLiteral("Time plot"));
    filled.add(QStringLiteral("Time plot"));
    QHash<QString, QSize> before;
    for (const LayoutPanel *panel : filled.layout().panels())
        before.insert(panel->id, filled.sizeOf(panel->id));
    filled.add(QStringLiteral("Gauge"));
    int changed = 0;
    for (auto each = before.cbegin(); each != before.cend(); ++each)
        changed += filled.sizeOf(each.key()) != each.value() ? 1 : 0;
    QCOMPARE(changed, 1);
}

void tst_PanelPlace::fullPageAcceptsMorePanels()
{
    FilledPage filled(QStringLiteral("Time plot"));
    for (int i = 0; i < 40; ++i)
        QVERIFY(!filled.add(i % 2 == 0 ? QStringLiteral("Gauge") : QStringLiteral("Time plot")).isEmpty());
    QCOMPARE(filled.layout().invariantError(), QString());
    for (const LayoutPanel *panel : filled.layout().panels())
        QVERIFY(filled.sizeOf(panel->id).width() > 50 && filled.sizeOf(panel->id).height() > 35);
}

QTEST_GUILESS_MAIN(tst_PanelPlace)
#include "tst_PanelPlace.moc"
