# For Doxygen: what the headers say of arguments, Returns and Trust is a
# paragraph each, and a function stands behind its comment.
/^#define tf_[a-z0-9_]* TF_LINK\(/d
s@^( *///) (Returns|Trust): @\1\n\1 **\2.** @
s@^( *///) ((and )?[a-z_0-9]+(, [a-z_0-9]+)*): (in|out|in/out)([,. ]|$)@\1\n\1 *\2*: \5\6@
