# Doxygen's view of a header: the comment at its top describes the file.
NR == 1 && /^\/\/ / { print "/// @file"; top = 1 }
top && !/^\/\// { top = 0 }
top { sub(/^\/\//, "///") }
{ print }
