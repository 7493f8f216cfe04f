#include "renderer/splats/mapped_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hipr {
namespace {

/// Closes on every way out.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) close(number);
    }
};

[[noreturn]] void fail() {
    throw SplatFileError(std::string("cannot be opened: ") + std::strerror(errno));
}

} // namespace

MappedFile::MappedFile(const std::string& path) {
    const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    struct stat status {};
    if (file.number < 0 || fstat(file.number, &status) != 0) fail();
    if (!S_ISREG(status.st_mode)) throw SplatFileError("is no file");
    if (status.st_size == 0) return; // cannot be mapped
    void* memory = mmap(nullptr, size_t(status.st_size), PROT_READ, MAP_PRIVATE, file.number, 0);
    if (memory == MAP_FAILED) fail();
    madvise(memory, size_t(status.st_size), MADV_SEQUENTIAL);
    _bytes = {static_cast<const unsigned char*>(memory), size_t(status.st_size)};
}

MappedFile::~MappedFile() {
    if (_bytes.data) munmap(const_cast<unsigned char*>(_bytes.data), _bytes.size);
}

} // namespace hipr
