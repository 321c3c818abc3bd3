// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FmuDescription.h"
#include "FmuExchange.h"
#include "FmuFolder.h"
#include "FmuInstance.h"
#include "FmuLog.h"

#include <chrono>
#include <memory>

namespace qplc {

/// An FMU that is opened, and what its standard allows when: load(), then as often as you like
/// reset(), initialize(), doStep() ..., end().
///
/// reset(), initialize(), writeInputs(), doStep() and readOutputs() throw a std::runtime_error with
/// a sentence if the FMU reports an error. Otherwise the last three allocate no memory. One thread
/// at a time.
class FmuModel
{
public:
    /// A start value that takes the place of the one of the FMU.
    struct Start
    {
        const FmuVariable *variable = nullptr;
        QVector<double> numbers;   // of each element
        QVector<qint64> integers;  // the same, exactly, where it is no real number
        QString text;              // of a String
    };
    struct Settings
    {
        std::optional<double> stopTime;   // [s]
        std::optional<double> tolerance;  // none: that of the default experiment
        QVector<Start> starts;
        bool logs = false;  // the FMU shall report more than warnings and errors
    };

    /// Opens the file of an FMU and reads its description. \return null, with a sentence in \a
    /// error, when it is not an FMU that is offered
    static std::unique_ptr<FmuModel> open(const QString &fileName, QString *error);
    ~FmuModel();
    FmuModel(const FmuModel &) = delete;
    FmuModel &operator=(const FmuModel &) = delete;

    const QString &fileName() const { return m_fileName; }
    const FmuDescription &description() const { return m_description; }
    /// Platforms for which it has a library.
    QStringList platforms() const { return m_platforms; }
    bool fitsHere() const { return !m_platform.isEmpty(); }
    /// Loads its library. From now on its code runs.
    bool load(QString *error);

    /// Reads a start value. \return false, with the reason and the remedy in \a error
    static bool readStart(const FmuDescription &description, const QString &name, const QString &text, Start *start,
                          QString *error);
    void setSettings(const Settings &settings) { m_settings = settings; }
    /// Variables that are written before each step, and those that readOutputs() reads. Filled
    /// before reset().
    FmuExchange &inputs() { return m_inputs; }
    FmuExchange &outputs() { return m_outputs; }

    /// Goes to the initialization, where the outputs have their initial values.
    void reset();
    /// Takes the initial inputs, and ends the initialization.
    void initialize();
    void readOutputs();
    /// Takes the inputs.
    void writeInputs();
    /// \a count steps [s], without an error that grows.
    static double multipleOf(double step, qint64 count);
    /// Sets the length of all steps [s], before the first one. Throws when the FMU cannot make
    /// steps of this length.
    void setStep(double step);
    /// Moves the time on by a step. Does nothing when isOver().
    void doStep();
    /// Time that the FMU has reached [s]: the start and a multiple of the step, never a sum.
    double time() const { return m_time; }
    /// The FMU has ended the simulation, or has refused a step.
    bool isOver() const { return m_isOver; }
    /// Why.
    QString overText() const;
    /// Ends the simulation in order. Does nothing when there is none.
    void end();

    FmuLog &log() { return *m_log; }

private:
    enum State : quint8 { NotLoaded, Loaded, Initializing, Stepping, Ended, Failed, Dead };

    explicit FmuModel(const QString &fileName)
        : m_fileName(fileName)
    {
    }
    bool read(QString *error);
    void writeStarts();
    void handleEvents(bool isInEventMode);
    void expect(int status, const char *doing);
    [[noreturn]] void fail(int status, const QString &doing);

    QString m_fileName;
    FmuDescription m_description;
    QStringList m_platforms;
    QString m_platform;  // the one of this computer
    Settings m_settings;
    FmuExchange m_inputs{2, false};
    FmuExchange m_outputs{2, false};
    const std::shared_ptr<FmuLog> m_log = std::make_shared<FmuLog>();
    std::unique_ptr<FmuFolder> m_folder;  // outlives the library
    std::unique_ptr<FmuInstance> m_instance;
    State m_state = NotLoaded;
    double m_start = 0.0;  // [s]
    double m_step = 0.0;   // [s]
    qint64 m_steps = 0;    // that are done
    double m_time = 0.0;   // [s]
    bool m_isOver = false;
    bool m_isRefused = false;
};

}  // namespace qplc
