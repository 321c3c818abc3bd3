// SPDX-License-Identifier: Apache-2.0
// check_panel [PICTURES]: the panel of docs/howto/write-a-panel.md in a window with a plant, all of
// it by the public API. Says what is wrong, and keeps a picture in each theme in the folder
// PICTURES.
#include "TwoCurves.h"

#include <QtCore/QElapsedTimer>
#include <QtPlcCore>

#include <cmath>
#include <cstdio>
#include <functional>

namespace {

const char table[] = "[wave]\ntype = Real64\nunit = m\n[power]\ntype = Real64\nunit = W\n";

class Source : public QPlcCompactSlaveNode
{
public:
    Source()
        : QPlcCompactSlaveNode(QStringLiteral("Source"))
    {
    }

private:
    QPlcOutput<double> m_wave{this, "wave"};
    QPlcOutput<double> m_power{this, "power"};

    void reset() override { m_time = 0.0; }
    void step(const QPlcCycle &cycle) override
    {
        m_time += cycle.dt();
        m_wave = std::sin(3.0 * m_time);
        m_power = 4000.0 * std::fmod(m_time, 1.0);
    }

    double m_time = 0.0;  // [s]
};

bool waitFor(const std::function<bool()> &condition)
{
    constexpr int patience = 20000;  // [ms]
    QElapsedTimer clock;
    clock.start();
    while (!condition() && clock.elapsed() < patience)
        QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
    return condition();
}

int countPixels(const QImage &image, const QColor &color)
{
    int count = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x)
            count += image.pixelColor(x, y) == color ? 1 : 0;
    }
    return count;
}

bool fail(const char *sentence)
{
    std::fprintf(stderr, "%s\n", sentence);
    return false;
}

TwoCurves *panelOf(QPlcControlCenter &window)
{
    for (QPlcWidget *panel : window.findChildren<QPlcWidget *>()) {
        if (panel->kind() == TwoCurves::typeName())
            return static_cast<TwoCurves *>(panel);
    }
    return nullptr;
}

/// A layout with the panel is opened before the window knows its kind, and loses nothing.
bool opensEarly(QPlcControlCenter &window)
{
    const QByteArray layout = R"({"format": "QtPLC layout", "version": 1, "currentTab": "tab1", "windows": [],
              "tabs": [{"id": "tab1", "name": "Mine", "tree": {"id": "panel1", "type": "Two curves",
              "settings": {"signals": ["wave", "power"], "later": 7}}}]})";
    QString error;
    if (!window.addLayout(QStringLiteral("Mine"), layout, &error) || !window.showLayout(QStringLiteral("Mine")))
        return fail(qPrintable(error));
    if (panelOf(window) || !window.layoutJson().contains("\"later\": 7"))
        return fail("an unknown kind of panel is not kept as it is");
    window.addPanel<TwoCurves>(QStringLiteral("Two of my curves"));
    window.addPanel<TwoCurves>();  // twice is once
    return window.layoutJson().contains("\"later\": 7") || fail("the panel forgets what it does not know");
}

bool isSeen(TwoCurves *panel, QPlcControlCenter &window, QPlcControlCenter::Theme name, const QString &file)
{
    window.setTheme(name);
    const QPlcTheme theme = panel->context()->theme();
    if (theme.isDark != (name == QPlcControlCenter::DarkTheme))
        return fail("the theme of the panel is not that of the window");
    constexpr int few = 100;  // [px]
    const auto isDrawn = [&] {
        const QImage image = panel->grab().toImage();
        return countPixels(image, theme.surface) > image.width() * image.height() / 2
            && countPixels(image, theme.curve(0)) > few && countPixels(image, theme.curve(1)) > few;
    };
    const bool isGood = waitFor(isDrawn);
    if (!file.isEmpty())
        window.grab().save(file);
    return isGood || fail("the curves are not seen");
}

bool check(const QString &pictures)
{
    QPlcMasterNode master;
    Source source;
    master.setSignalTable(QPlcSignalTable::fromIni(table));
    master.setInterval(std::chrono::milliseconds(10));
    if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)) || !master.addLocalNode(&source))
        return fail(qPrintable(master.errorString()));
    QPlcControlCenter window;
    window.resize(1000, 600);
    window.show();
    if (!opensEarly(window))
        return false;
    TwoCurves *panel = panelOf(window);
    if (!panel || panel->title() != QLatin1String("Two of my curves"))
        return fail("the panel does not appear with the title of its kind");
    const QString plant = window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(master.serverPort()));
    if (!waitFor([&] { return window.isConnected(plant); }) || !master.startRealTime())
        return fail("the window does not connect");
    const auto past = [&] { return panel->context()->history(QStringLiteral("wave"), 0, panel->context()->end()); };
    if (!waitFor([&] { return past().size() > 200; }))
        return fail("the panel has no history");
    panel->context()->showRange(past().constLast().time - 2'000'000'000, past().constLast().time);
    const auto file = [&](const char *name) { return pictures.isEmpty() ? QString() : pictures + '/' + name; };
    const bool isGood = isSeen(panel, window, QPlcControlCenter::LightTheme, file("light.png"))
        && isSeen(panel, window, QPlcControlCenter::DarkTheme, file("dark.png"));
    master.removeLocalNode(&source);
    return isGood;
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcGuiApplication application(argc, argv);
    return check(application.arguments().value(1)) ? 0 : 1;
}
