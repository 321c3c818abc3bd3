// SPDX-License-Identifier: Apache-2.0
#include "PlotBenchOptions.h"

#include <QtCore/QCommandLineParser>
#include <QtCore/QCoreApplication>

#include <cstdio>

namespace {

constexpr int success = 0;
constexpr int usageError = 2;

/// Options with ranges; the first one that is wrong is told.
class Reader
{
public:
    Reader()
    {
        m_parser.setApplicationDescription(QStringLiteral(
            "Measures what live time plots cost: a 1 kHz source, offscreen pictures, one line of JSON."));
        m_help = m_parser.addHelpOption();
    }

    void add(const char *name, const char *description, const char *valueName, const QString &value)
    {
        m_parser.addOption(
            {QString::fromLatin1(name), QString::fromLatin1(description), QString::fromLatin1(valueName), value});
    }
    bool parse(const QStringList &arguments)
    {
        if (!m_parser.parse(arguments))
            return fail(m_parser.errorText());
        return m_parser.positionalArguments().isEmpty()
            || fail(QStringLiteral("%1: the program takes options only").arg(m_parser.positionalArguments().first()));
    }
    bool isHelpWanted() const { return m_parser.isSet(m_help); }
    QString helpText() const { return m_parser.helpText(); }
    QString value(const char *name) const { return m_parser.value(QString::fromLatin1(name)); }

    bool number(const char *name, double minimum, double maximum, double *result)
    {
        bool isNumber = false;
        *result = value(name).toDouble(&isNumber);
        return (isNumber && *result >= minimum && *result <= maximum)
            || fail(QStringLiteral("--%1 %2: use a number in %3 ... %4")
                        .arg(QString::fromLatin1(name), value(name), QString::number(minimum, 'g', 8),
                             QString::number(maximum, 'g', 8)));
    }
    bool integer(const char *name, int minimum, int maximum, int *result)
    {
        double real = 0.0;
        if (!number(name, minimum, maximum, &real))
            return false;
        *result = int(real);
        return *result == real
            || fail(QStringLiteral("--%1 %2: use a whole number").arg(QString::fromLatin1(name), value(name)));
    }
    bool fail(const QString &text)
    {
        std::fprintf(stderr, "qtplc_plot_bench: %s\n", qPrintable(text));
        return false;
    }

private:
    QCommandLineParser m_parser;
    QCommandLineOption m_help{QStringLiteral("help")};
};

void declare(Reader *reader, const PlotBenchOptions &defaults)
{
    reader->add("plots", "Number of plots in the window.", "N", QString::number(defaults.plots));
    reader->add("curves", "Curves of each plot.", "N", QString::number(defaults.curves));
    reader->add("points", "Samples of each curve, all of them in view.", "N", QString::number(defaults.points));
    reader->add("fps", "Frames per second.", "N", QString::number(defaults.fps));
    reader->add("seconds", "Measured time.", "S", QString::number(defaults.seconds));
    reader->add("mode", "every-frame: all plots in each frame; new-column: a plot when it has changed.", "MODE",
                QStringLiteral("every-frame"));
    reader->add("channels", "Channels of the store; 0: one for each curve.", "N", QStringLiteral("0"));
    reader->add("line-width", "Width of the curves [px].", "PX", QString::number(defaults.lineWidth));
    reader->add("noise", "Amplitude of the noise; the axes go from -2 to 2.", "A", QString::number(defaults.noise));
    reader->add("picture", "Write a picture of the window at the end.", "FILE.png", QString());
}

bool readChannels(Reader *reader, PlotBenchOptions *options)
{
    const int curves = options->plots * options->curves;
    if (!reader->integer("channels", 0, 10'000, &options->channels))
        return false;
    if (options->channels == 0)
        options->channels = curves;
    return options->channels >= curves
        || reader->fail(
            QStringLiteral("--channels %1: use %2 or more, one for each curve").arg(options->channels).arg(curves));
}

bool readValues(Reader *reader, PlotBenchOptions *options)
{
    const QString mode = reader->value("mode");
    options->drawsEveryFrame = mode == QLatin1String("every-frame");
    options->picture = reader->value("picture");
    if (!options->drawsEveryFrame && mode != QLatin1String("new-column"))
        return reader->fail(QStringLiteral("--mode %1: use every-frame or new-column").arg(mode));
    return reader->integer("plots", 1, 64, &options->plots) && reader->integer("curves", 1, 64, &options->curves)
        && reader->integer("points", 100, 100'000'000, &options->points)
        && reader->integer("fps", 1, 1000, &options->fps) && reader->number("seconds", 0.01, 86400.0, &options->seconds)
        && reader->number("line-width", 0.1, 20.0, &options->lineWidth)
        && reader->number("noise", 0.0, 2.0, &options->noise) && readChannels(reader, options);
}

}  // namespace

bool PlotBenchOptions::read(const QCoreApplication &application, PlotBenchOptions *options, int *exitCode)
{
    Reader reader;
    declare(&reader, *options);
    *exitCode = usageError;
    if (!reader.parse(application.arguments()))
        return false;
    if (reader.isHelpWanted()) {
        std::fputs(qPrintable(reader.helpText()), stdout);
        *exitCode = success;
        return false;
    }
    return readValues(&reader, options);
}
