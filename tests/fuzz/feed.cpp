// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"

#include <QtCore/QByteArray>
#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QVector>

#include <csignal>
#include <cstdio>
#include <random>
#include <vector>

extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

constexpr int longest = 4096;

/// The inputs of the corpus, in the order of their names; the words of the dictionary.
struct Food
{
    QVector<QByteArray> inputs;
    QVector<QByteArray> words;
};

/// "\x41b" means "Ab".
QByteArray unescaped(const QByteArray &text)
{
    QByteArray bytes;
    for (int i = 0; i < text.size(); ++i) {
        if (text.at(i) != '\\') {
            bytes += text.at(i);
        } else if (text.mid(i + 1, 1) == "x") {
            bytes += QByteArray::fromHex(text.mid(i + 2, 2));
            i += 3;
        } else {
            bytes += text.at(++i);
        }
    }
    return bytes;
}

Food readFood(const QString &folder, const QString &dictionary)
{
    Food food;
    for (const QFileInfo &info : QDir(folder).entryInfoList(QDir::Files, QDir::Name)) {
        QFile file(info.filePath());
        fuzz::check(file.open(QIODevice::ReadOnly), "an input can be read");
        food.inputs << file.readAll();
    }
    fuzz::check(!food.inputs.isEmpty(), "there are inputs in the folder");
    QFile file(dictionary);
    if (dictionary.isEmpty())
        return food;
    fuzz::check(file.open(QIODevice::ReadOnly), "the dictionary can be read");
    for (const QByteArray &line : file.readAll().split('\n')) {
        if (line.startsWith('"'))
            food.words << unescaped(line.mid(1, line.lastIndexOf('"') - 1));
    }
    return food;
}

/// Changes inputs at random; the same seed makes the same changes.
class Cook
{
public:
    Cook(const Food &food, unsigned seed)
        : m_food(food)
        , m_random(seed)
    {
    }

    QByteArray next()
    {
        QByteArray input = any(m_food.inputs);
        for (int changes = 1 + below(8); changes > 0; --changes)
            change(&input);
        return input.left(longest);
    }

private:
    int below(int end) { return int(m_random() % unsigned(end)); }
    const QByteArray &any(const QVector<QByteArray> &from) { return from.at(below(from.size())); }

    void change(QByteArray *input)
    {
        const int at = below(input->size() + 1);
        const bool hasByte = at < input->size();
        switch (below(6)) {
        case 0:
            if (hasByte)
                (*input)[at] = char(input->at(at) ^ (1 << below(8)));
            break;
        case 1:
            if (hasByte)
                (*input)[at] = "\x00\x01\x7f\x80\xff"[below(5)];
            break;
        case 2:
            input->remove(at, 1 + below(16));
            break;
        case 3:
            input->insert(at, m_food.words.isEmpty() ? QByteArray(1 + below(16), char(below(256))) : any(m_food.words));
            break;
        case 4:
            input->insert(at, input->mid(below(input->size() + 1), 1 + below(64)));
            break;
        default:
            input->replace(at, input->size(), any(m_food.inputs).mid(at));  // goes on as another one
            break;
        }
    }

    const Food &m_food;
    std::mt19937 m_random;
};

std::vector<std::uint8_t> current;

/// Keeps the input that ended the program.
void keepCurrent()
{
    static bool isKept = false;
    if (isKept)
        return;
    isKept = true;
    if (std::FILE *file = std::fopen("finding", "wb")) {
        std::fwrite(current.data(), 1, current.size(), file);
        std::fclose(file);
        std::fputs("The input is in the file 'finding' of this folder.\n", stderr);
    }
}

void feed(const QByteArray &input)
{
    // In memory of its own, without the 0 that a QByteArray has at its end.
    current.assign(input.begin(), input.end());
    current.shrink_to_fit();
    LLVMFuzzerTestOneInput(current.data(), current.size());
}

}  // namespace

/// Gives a fuzzer all inputs of its corpus, and \a count that were made of them at random, with the
/// same seed each time: a test for each change, with the sanitizers of gcc. Arguments: folder,
/// count, and a dictionary if there is one.
int main(int argc, char **argv)
{
    fuzz::check(argc >= 3, "the arguments are a folder, a count and, if there is one, a dictionary");
    std::signal(SIGABRT, [](int) { keepCurrent(); });
    if (__sanitizer_set_death_callback)
        __sanitizer_set_death_callback(keepCurrent);
    const Food food = readFood(QString::fromLocal8Bit(argv[1]), argc > 3 ? QString::fromLocal8Bit(argv[3]) : QString());
    for (const QByteArray &input : food.inputs)
        feed(input);
    const int count = QByteArray(argv[2]).toInt();
    Cook cook(food, 1);
    for (int i = 0; i < count; ++i)
        feed(cook.next());
    std::printf("%d inputs of the corpus, %d made of them: nothing found\n", int(food.inputs.size()), count);
    return 0;
}
