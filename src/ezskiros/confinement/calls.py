"""The system calls that checked code may make on Linux: calls for computing and reading.

The kernel refuses all others (seccomp): writing and changing files, the network, new processes,
signals to others. libseccomp, which `apt` also uses, builds the filter for the kernel.
"""

from __future__ import annotations

import ctypes
import errno
import os

from ezskiros.confinement.unconfined import UnconfinedError

_ALLOWED = """
    read readv pread64 preadv preadv2 write writev pwrite64 lseek close close_range
    access faccessat faccessat2 stat fstat lstat newfstatat fstatat64 statx statfs fstatfs
    readlink readlinkat getdents getdents64 getcwd chdir fchdir umask
    getxattr lgetxattr fgetxattr listxattr llistxattr flistxattr
    mmap mprotect munmap mremap madvise msync mincore brk get_mempolicy membarrier
    dup dup2 dup3 pipe pipe2 eventfd2 socketpair sendto recvfrom shutdown getsockname getpeername
    getsockopt flock fadvise64 readahead
    select pselect6 poll ppoll epoll_create1 epoll_ctl epoll_wait epoll_pwait
    rt_sigaction rt_sigprocmask rt_sigreturn rt_sigpending rt_sigtimedwait sigaltstack
    restart_syscall pause
    exit exit_group wait4 waitid set_tid_address set_robust_list get_robust_list rseq arch_prctl
    futex futex_waitv
    sched_yield sched_getaffinity sched_getparam sched_getscheduler sched_get_priority_max
    sched_get_priority_min getcpu getpriority
    getpid getppid gettid getpgrp getpgid getsid getuid geteuid getgid getegid getresuid getresgid
    getgroups capget
    nanosleep clock_nanosleep clock_gettime clock_getres gettimeofday time times
    setitimer getitimer alarm
    getrandom getrusage getrlimit sysinfo uname
"""
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
_THREAD = 0x10000
"""`CLONE_THREAD`: the call starts a thread of this process."""
_OF_TERMINALS = (0x5401, 0x5413, 0x541B, 0x5421, 0x5450, 0x5451)
"""`TCGETS`, `TIOCGWINSZ`, `FIONREAD`, `FIONBIO`, `FIONCLEX`, `FIOCLEX`: these change nothing
outside this process.
"""
_OF_FILES = (0, 1, 2, 3, 4, 5, 6, 7, 1030)
"""`F_DUPFD` up to `F_SETLKW`, and `F_DUPFD_CLOEXEC`: commands that send no signals to others."""
_OF_THREADS = (15, 16)
"""`PR_SET_NAME` and `PR_GET_NAME`."""

_LIBRARY = "libseccomp.so.2"
_ALLOW, _REFUSE, _MISSING = 0x7FFF0000, 0x00050000 | errno.EPERM, 0x00050000 | errno.ENOSYS
_EQUAL, _MASKED_EQUAL = 4, 7


class _Comparison(ctypes.Structure):
    """`struct scmp_arg_cmp`: the required value of an argument of a call."""

    _fields_ = (
        ("argument", ctypes.c_uint),
        ("operation", ctypes.c_int),
        ("first", ctypes.c_uint64),
        ("second", ctypes.c_uint64),
    )


def confine_calls() -> None:
    """Forbid all other system calls to this process from now on. Raises `UnconfinedError`."""
    process = os.getpid()
    rules = _Filter()
    for name in _ALLOWED.split():
        rules.allow(name)
    rules.allow("open", _Comparison(1, _MASKED_EQUAL, _WRITING, 0))
    rules.allow("openat", _Comparison(2, _MASKED_EQUAL, _WRITING, 0))
    rules.allow("clone", _Comparison(0, _MASKED_EQUAL, _THREAD, _THREAD))
    # The flags of `clone3` are in memory, where no filter can read them. Without `clone3`, programs
    # call `clone`.
    rules.add(_MISSING, "clone3")
    rules.allow("prlimit64", _Comparison(2, _EQUAL, 0, 0))  # reads limits, and sets none
    rules.allow("sched_setaffinity", _Comparison(0, _EQUAL, 0, 0))
    rules.allow("kill", _Comparison(0, _EQUAL, process, 0))
    rules.allow("tgkill", _Comparison(0, _EQUAL, process, 0))
    for name, numbers in (("ioctl", _OF_TERMINALS), ("fcntl", _OF_FILES)):
        for number in numbers:
            rules.allow(name, _Comparison(1, _EQUAL, number, 0))
    for number in _OF_THREADS:
        rules.allow("prctl", _Comparison(0, _EQUAL, number, 0))
    rules.load()


class _Filter:
    """A filter of libseccomp."""

    def __init__(self) -> None:
        try:
            self._library = ctypes.CDLL(_LIBRARY)
        except OSError:
            raise UnconfinedError(f"{_LIBRARY} is missing: apt-get install libseccomp2") from None
        self._library.seccomp_init.restype = ctypes.c_void_p
        self._context = ctypes.c_void_p(self._library.seccomp_init(ctypes.c_uint32(_REFUSE)))

    def allow(self, name: str, *needed: _Comparison) -> None:
        self.add(_ALLOW, name, *needed)

    def add(self, action: int, name: str, *needed: _Comparison) -> None:
        """Set the answer to a call whose arguments have the required values."""
        number = self._library.seccomp_syscall_resolve_name(name.encode())
        if number < 0:
            return  # not on this processor, or newer than the library: the call stays refused
        comparisons = (_Comparison * len(needed))(*needed)
        self._demand(
            self._library.seccomp_rule_add_array(
                self._context, ctypes.c_uint32(action), number, len(needed), comparisons
            )
        )

    def load(self) -> None:
        """Load the filter into the kernel."""
        self._demand(self._library.seccomp_load(self._context))
        self._library.seccomp_release(self._context)

    def _demand(self, result: int) -> None:
        if result:
            raise UnconfinedError(f"the kernel rejects the filter: {os.strerror(-result).lower()}")
