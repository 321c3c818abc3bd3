// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "gui/layout/ShareSplitter.h"

using namespace qplc;

namespace {

/// A part that wants this width.
class Part : public QWidget
{
public:
    explicit Part(int width)
        : m_width(width)
    {
    }
    QSize sizeHint() const override { return {m_width, 100}; }

private:
    int m_width;
};

}  // namespace

class tst_ShareSplitter : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void sharesOverrideSizeHints_data();
    void sharesOverrideSizeHints();
};

void tst_ShareSplitter::sharesOverrideSizeHints_data()
{
    QTest::addColumn<QVector<int>>("shares");
    QTest::newRow("equal") << QVector<int>{5000, 5000};
    QTest::newRow("left") << QVector<int>{8000, 2000};
    QTest::newRow("right") << QVector<int>{2000, 8000};
}

void tst_ShareSplitter::sharesOverrideSizeHints()
{
    QFETCH(QVector<int>, shares);
    ShareSplitter splitter(Qt::Horizontal);
    splitter.addWidget(new Part(100));
    splitter.addWidget(new Part(500));
    splitter.showShares({}, shares);
    splitter.resize(1000 + splitter.handleWidth(), 200);
    splitter.show();
    QVERIFY(QTest::qWaitForWindowExposed(&splitter));
    QCOMPARE(splitter.sizes(), (QList<int>{shares.at(0) / 10, shares.at(1) / 10}));
}

QTEST_MAIN(tst_ShareSplitter)
#include "tst_ShareSplitter.moc"
